#pragma once
// Closest points on a surface of triangles. The tree is our own, not CGAL's: plain data that can be copied with its
// tool, is safe and gives the same bits from any thread, and tells on which vertex, edge or face the closest point is,
// which the sign needs.
#include <span>

#include "core/types.hpp"

namespace knap {

using Triangle = std::array<Index, 3>;

/// A box of triangles: two boxes within, or up to four triangles.
struct TreeBox {
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< [m]
  Index first = 0;                               ///< of the triangles, in `order`
  Index count = 0;                               ///< of the triangles in a leaf; 0 = boxes within
  Index second = none;                           ///< the second box within; the first follows its parent
};

/// Consistently oriented triangles, manifold, normals out of the solid where it is closed.
struct TriangleSurface {
  std::vector<Vec3> vertices;  ///< [m]
  std::vector<Triangle> triangles;
  bool closed = false;  ///< every edge has two triangles

  // Derived by complete_surface.
  std::vector<std::array<Index, 3>> neighbours;   ///< of a triangle, across the edge opposite each corner; none = rim
  std::vector<Vec3> face_normals;                 ///< unit
  std::vector<std::array<Vec3, 3>> edge_normals;  ///< of the edge opposite each corner: sum of its faces' normals
  std::vector<Vec3> vertex_normals;               ///< weighted by the angles of the faces at the vertex
  std::vector<TreeBox> tree;
  std::vector<Index> order;  ///< of the triangles in the tree
};

/// Fills in what is derived. The triangles must be oriented consistently, two at most to an edge.
void complete_surface(TriangleSurface& surface);

/// The edges with one triangle only.
struct Rim {
  Index num_edges = 0;
  Vec3 place = Vec3::Zero();  ///< the middle of the first [m]
};
Rim rim_of(const TriangleSurface& surface);

/// The point of the surface nearest to another.
struct SurfacePoint {
  Vec3 point = Vec3::Zero();   ///< [m]
  Vec3 normal = Vec3::Zero();  ///< pseudo-normal of the face, edge or vertex it is on, not unit
  double distance = 0.0;       ///< [m]
  bool on_face = false;        ///< inside a face; its normal is unit then
};

/// Its normal says on which side of a closed surface the other point is, even at edges and corners (Baerentzen & Aanaes
/// 2005, "Signed distance computation using the angle weighted pseudonormal").
SurfacePoint closest_point(const TriangleSurface& surface, const Vec3& to);

}  // namespace knap
