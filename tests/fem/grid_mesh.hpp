#pragma once
// A cube of n^3 cells, six tets each (Kuhn), interior vertices jittered, cells and vertices in Morton order: an
// irregular mesh of any size without a mesh generator.
#include <algorithm>
#include <random>

#include "core/tet_mesh.hpp"

namespace knap {

/// Interleaves the lowest ten bits of three indices.
inline std::uint32_t morton_code(const std::array<Index, 3>& cell) {
  std::uint32_t code = 0;
  for (std::uint32_t bit = 0; bit < 10; ++bit)
    for (std::uint32_t k = 0; k < 3; ++k) code |= ((static_cast<std::uint32_t>(cell[k]) >> bit) & 1u) << (3 * bit + k);
  return code;
}

inline std::vector<std::array<Index, 3>> morton_cells(Index n) {
  std::vector<std::array<Index, 3>> cells;
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j)
      for (Index k = 0; k < n; ++k) cells.push_back({i, j, k});
  std::sort(cells.begin(), cells.end(), [](auto& a, auto& b) { return morton_code(a) < morton_code(b); });
  return cells;
}

/// Cube of edge `length` [m]; jitter relative to the cell, below 0.2 keeps every tet positive.
inline TetMesh grid_mesh(Index n, double length, double jitter, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-jitter, jitter);
  const double h = length / n;
  TetMesh mesh;
  std::vector<Index> vertex_of_point(at((n + 1) * (n + 1) * (n + 1)));
  const auto point = [&](const std::array<Index, 3>& p) { return at((p[0] * (n + 1) + p[1]) * (n + 1) + p[2]); };
  for (const auto& p : morton_cells(n + 1)) {
    vertex_of_point[point(p)] = mesh.num_vertices();
    Vec3 x(p[0], p[1], p[2]);
    for (int k = 0; k < 3; ++k) {
      const double s = shift(random);
      if (p[at(k)] > 0 && p[at(k)] < n) x[k] += s;
    }
    mesh.vertices.push_back(h * x);
  }
  constexpr std::array<std::array<std::size_t, 3>, 6> paths{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  for (const auto& cell : morton_cells(n))
    for (std::size_t path = 0; path < 6; ++path) {
      auto corner = cell;
      TetCorners tet{vertex_of_point[point(corner)]};
      for (std::size_t k = 0; k < 3; ++k) {
        ++corner[paths[path][k]];
        tet[k + 1] = vertex_of_point[point(corner)];
      }
      if (path >= 3) std::swap(tet[2], tet[3]);
      mesh.tets.push_back(tet);
    }
  return mesh;
}

}  // namespace knap
