#pragma once
#include <span>

#include "core/types.hpp"

namespace knap {

/// The convex hull of a point set. A set without volume (flat, fewer than four points, not finite) keeps all its
/// points.
struct ConvexHull {
  std::vector<Vec3> points;  ///< its corners [m]
  double volume = 0.0;       ///< [m3]
};
ConvexHull convex_hull(std::span<const Vec3> points);

}  // namespace knap
