#pragma once
#include "fem/elastic_kernel.hpp"

namespace knap {

/// Traction [Pa] that a stress exerts on a plane with current unit normal n.
inline Vec3 traction(const TetStress& s, const Vec3& n) {
  return {s.xx * n.x() + s.xy * n.y() + s.zx * n.z(), s.xy * n.x() + s.yy * n.y() + s.yz * n.z(),
          s.zx * n.x() + s.yz * n.y() + s.zz * n.z()};
}

/// Traction [Pa] on a facet with current unit normal n, from the mean stress of its two tets.
inline Vec3 facet_traction(const TetStress& minus, const TetStress& plus, const Vec3& n) {
  return 0.5 * (traction(minus, n) + traction(plus, n));
}

/// At least the magnitude of facet_traction for any normal [Pa]; cheap, to skip the facets that cannot fail.
inline double facet_traction_bound(const TetStress& minus, const TetStress& plus) {
  return 0.5 * (minus.norm + plus.norm);
}

}  // namespace knap
