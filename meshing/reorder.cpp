#include "meshing/reorder.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace knap {
namespace {

// Spreads the low 21 bits of a number so that two zero bits follow each.
std::uint64_t spread_bits(std::uint64_t n) {
  n &= 0x1fffff;
  n = (n | n << 32) & 0x1f00000000ffff;
  n = (n | n << 16) & 0x1f0000ff0000ff;
  n = (n | n << 8) & 0x100f00f00f00f00f;
  n = (n | n << 4) & 0x10c30c30c30c30c3;
  return (n | n << 2) & 0x1249249249249249;
}

struct MortonGrid {
  Vec3 origin;
  double cells_per_length;

  std::uint64_t code(const Vec3& x) const {
    std::uint64_t code = 0;
    for (int k = 0; k < 3; ++k) {
      const double cell = std::clamp((x[k] - origin[k]) * cells_per_length, 0.0, 2097151.0);
      code |= spread_bits(static_cast<std::uint64_t>(cell)) << k;
    }
    return code;
  }
};

MortonGrid make_grid(const TetMesh& mesh) {
  const BoundingBox box = bounding_box(mesh);
  const double length = box.largest_extent();
  return {box.low, length > 0.0 ? 2097152.0 / length : 0.0};
}

// The permutation that sorts the codes, ties by index.
std::vector<Index> sorted_order(const std::vector<std::uint64_t>& codes) {
  std::vector<Index> order(codes.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return codes[at(a)] < codes[at(b)]; });
  return order;
}

std::vector<Index> vertex_order(const TetMesh& mesh, const MortonGrid& grid) {
  std::vector<bool> used(mesh.vertices.size(), false);
  for (const TetCorners& tet : mesh.tets)
    for (const Index v : tet) used[at(v)] = true;
  std::vector<std::uint64_t> codes(mesh.vertices.size());
  for (std::size_t i = 0; i < codes.size(); ++i) codes[i] = used[i] ? grid.code(mesh.vertices[i]) : 0;
  std::vector<Index> order = sorted_order(codes);
  std::erase_if(order, [&](Index v) { return !used[at(v)]; });
  return order;
}

}  // namespace

TetMesh morton_ordered(const TetMesh& mesh) {
  if (mesh.tets.empty()) return {};
  const MortonGrid grid = make_grid(mesh);
  TetMesh ordered;
  std::vector<Index> new_index(mesh.vertices.size(), none);
  for (const Index v : vertex_order(mesh, grid)) {
    new_index[at(v)] = ordered.num_vertices();
    ordered.vertices.push_back(mesh.vertices[at(v)]);
  }
  std::vector<std::uint64_t> codes;
  codes.reserve(mesh.tets.size());
  for (const auto& [a, b, c, d] : mesh.tets)
    codes.push_back(
        grid.code(0.25 * (mesh.vertices[at(a)] + mesh.vertices[at(b)] + mesh.vertices[at(c)] + mesh.vertices[at(d)])));
  ordered.tets.reserve(mesh.tets.size());
  for (const Index t : sorted_order(codes)) {
    const auto& [a, b, c, d] = mesh.tets[at(t)];
    ordered.tets.push_back({new_index[at(a)], new_index[at(b)], new_index[at(c)], new_index[at(d)]});
  }
  return ordered;
}

}  // namespace knap
