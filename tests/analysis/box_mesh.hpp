#pragma once

#include "analysis/fragments.hpp"
#include "core/topology.hpp"

namespace knap {

/// A box of cells [0, n) x length / n, each cut into six tets around its diagonal; corner of the box at the origin.
inline TetMesh box_mesh(const Vec3& length, const std::array<Index, 3>& n) {
  TetMesh mesh;
  const auto vertex = [&](Index i, Index j, Index k) { return (k * (n[1] + 1) + j) * (n[0] + 1) + i; };
  for (Index k = 0; k <= n[2]; ++k)
    for (Index j = 0; j <= n[1]; ++j)
      for (Index i = 0; i <= n[0]; ++i)
        mesh.vertices.emplace_back(length.x() * i / n[0], length.y() * j / n[1], length.z() * k / n[2]);
  constexpr std::array<std::array<int, 3>, 6> paths{{{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
  for (Index k = 0; k < n[2]; ++k)
    for (Index j = 0; j < n[1]; ++j)
      for (Index i = 0; i < n[0]; ++i)
        for (const auto& path : paths) {
          std::array<Index, 3> corner{i, j, k};
          TetCorners tet{vertex(i, j, k), none, none, none};
          for (std::size_t step = 0; step < 3; ++step) {
            ++corner[at(path[step])];
            tet[step + 1] = vertex(corner[0], corner[1], corner[2]);
          }
          mesh.tets.push_back(tet);
          if (tet_volume(mesh, mesh.num_tets() - 1) < 0.0) std::swap(mesh.tets.back()[2], mesh.tets.back()[3]);
        }
  return mesh;
}

/// A mesh in motion with everything FragmentInput borrows; one fragment at rest to begin with.
struct MovingMesh {
  Topology topology;
  std::vector<Vec4> x, v;
  std::vector<double> tet_volumes, densities;
  std::vector<Index> label;

  explicit MovingMesh(const TetMesh& mesh) : topology(make_topology(mesh)) {
    for (const Vec3& p : mesh.vertices) x.push_back(padded(p));
    v.assign(x.size(), Vec4::Zero());
    for (Index tet = 0; tet < mesh.num_tets(); ++tet) tet_volumes.push_back(tet_volume(mesh, tet));
    label.assign(at(mesh.num_tets()), 0);
  }

  FragmentInput input(double density = 1.0) {
    densities = {density};
    return {.tet_nodes = topology.tet_nodes,
            .tet_facets = topology.tet_facets,
            .facet_tets = topology.facet_tets,
            .x = x,
            .v = v,
            .tet_volume = tet_volumes,
            .densities = densities,
            .label = label};
  }
  Vec3 tet_centre(Index tet) const {
    Vec3 sum = Vec3::Zero();
    for (const Index node : topology.tet_nodes[at(tet)]) sum += 0.25 * xyz(x[at(node)]);
    return sum;
  }
};

}  // namespace knap
