#pragma once
#include <span>

#include "core/types.hpp"

namespace knap {

/// A tetrahedral mesh, immutable after meshing. A tet (a, b, c, d) is positive: (b-a) x (c-a) . (d-a) > 0.
struct TetMesh {
  std::vector<Vec3> vertices;    ///< [m]
  std::vector<TetCorners> tets;  ///< vertex indices

  Index num_vertices() const { return to_index(vertices.size()); }
  Index num_tets() const { return to_index(tets.size()); }
};

/// The meshes in one, vertices and tets one mesh after the other.
TetMesh merged(std::span<const TetMesh> meshes);

/// Signed volume [m3] of the tet (a, b, c, d).
inline double tet_volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return (b - a).cross(c - a).dot(d - a) / 6.0;
}
double tet_volume(const TetMesh& mesh, Index tet);
/// Total volume [m3].
double volume(const TetMesh& mesh);
/// The box around the vertices that tets use.
struct BoundingBox {
  Vec3 low, high;  ///< [m]
  double largest_extent() const { return (high - low).maxCoeff(); }
};
/// Of a mesh with at least one tet.
BoundingBox bounding_box(const TetMesh& mesh);
/// Mean length [m] over the distinct edges.
double mean_edge(const TetMesh& mesh);

/// The corners of the facet opposite corner i, in the order whose right-hand normal points out of a positive tet.
inline constexpr std::array<std::array<int, 3>, 4> facet_of_corner{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

}  // namespace knap
