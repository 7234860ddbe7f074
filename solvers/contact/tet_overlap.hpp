#pragma once
// Where two tets overlap. The gradient of the overlap volume with respect to a motion of the second tet is minus the
// area vector of its boundary inside the first; so the area vectors of the boundaries give the direction that parts the
// two, whatever touches: a vertex and a face, two edges (their cross product exactly), two faces, or anything between
// these. Over closed surfaces the vectors of both sides are opposite and equal; where only some faces of a tet are
// free, those of neighbouring pairs complete them, see contact_pairs. The alternative, points in tets and edges against
// edges, has to tell apart cases that round-off mixes up.
#include <span>

#include "core/tet_mesh.hpp"

namespace knap {

/// A tet as the tests below need it.
struct TetShape {
  std::array<Vec3, 4> corners;
  std::array<Vec3, 4> gradient;  ///< of its barycentric coordinates [1/m]
  std::array<double, 4> height;  ///< of each corner above its opposite face [m]
  bool is_solid = false;         ///< of positive volume; others touch nothing, their gradients and heights are 0

  /// Barycentric coordinate i of a point.
  double coordinate(std::size_t i, const Vec3& p) const {
    return gradient[i].dot(p - corners[0]) + (i == 0 ? 1.0 : 0.0);
  }
  /// All four; they sum to 1 exactly.
  std::array<double, 4> coordinates(const Vec3& p) const;
};
TetShape make_tet_shape(const TetCorners& nodes, std::span<const Vec4> x);

/// Barycentric coordinates of a point in a tet, without its shape; they sum to 1. All equal in one without volume.
std::array<double, 4> coordinates_in(const TetCorners& nodes, const Vec3& p, std::span<const Vec4> x);

/// Lower bound of the distance between two tets [m], by the planes of their faces; 0 if none of these separates them.
double separation_by_faces(const TetShape& a, const TetShape& b);
/// The same by the directions normal to an edge of each.
double separation_by_edges(const TetShape& a, const TetShape& b);

/// The free faces of two tets as far as they lie inside the other one.
struct OverlapPatch {
  Vec3 area = Vec3::Zero();    ///< half of (area vector of a's faces - that of b's): points from a to b [m2]
  Vec3 centre = Vec3::Zero();  ///< weighted by area [m]
  double size = 0.0;           ///< area without direction, both sides [m2]; 0 = no free face inside the other tet
  std::array<Vec3, 3> corners{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};  ///< far apart, see far_corners [m]
};
/// free_faces: bit i = face opposite corner i. Corners stay zero if they are not needed.
OverlapPatch overlap_patch(const TetShape& a, unsigned free_faces_of_a, const TetShape& b, unsigned free_faces_of_b,
                           bool needs_corners = true);

}  // namespace knap
