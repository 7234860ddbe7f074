#pragma once
#include "core/tet_mesh.hpp"

namespace knap {

/// A box of cells[0] x cells[1] x cells[2] cells of edge `cell` [m] from the origin, six tets each (Kuhn): every plane
/// between cells is made of facets.
inline TetMesh bar_mesh(const std::array<Index, 3>& cells, double cell) {
  TetMesh mesh;
  const auto vertex = [&](Index i, Index j, Index k) { return (i * (cells[1] + 1) + j) * (cells[2] + 1) + k; };
  for (Index i = 0; i <= cells[0]; ++i)
    for (Index j = 0; j <= cells[1]; ++j)
      for (Index k = 0; k <= cells[2]; ++k) mesh.vertices.push_back(cell * Vec3(i, j, k));
  constexpr std::array<std::array<std::size_t, 3>, 6> paths{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  for (Index i = 0; i < cells[0]; ++i)
    for (Index j = 0; j < cells[1]; ++j)
      for (Index k = 0; k < cells[2]; ++k)
        for (const auto& path : paths) {
          std::array<Index, 3> corner{i, j, k};
          TetCorners tet{vertex(i, j, k)};
          for (std::size_t step = 0; step < 3; ++step) {
            ++corner[path[step]];
            tet[step + 1] = vertex(corner[0], corner[1], corner[2]);
          }
          mesh.tets.push_back(tet);
          if (tet_volume(mesh, mesh.num_tets() - 1) < 0.0) std::swap(mesh.tets.back()[2], mesh.tets.back()[3]);
        }
  return mesh;
}

}  // namespace knap
