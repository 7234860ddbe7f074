#pragma once
#include <span>

#include "core/types.hpp"

namespace knap {

/// Symmetric Cauchy stress of a tet [Pa], one cache line.
struct alignas(64) TetStress {
  double xx = 0.0, yy = 0.0, zz = 0.0, yz = 0.0, zx = 0.0, xy = 0.0;  ///< [Pa]
  double volume_ratio = 1.0;                                          ///< J [-], <= 0 when inverted
};

inline Mat3 as_matrix(const TetStress& s) { return Mat3{{s.xx, s.xy, s.zx}, {s.xy, s.yy, s.yz}, {s.zx, s.yz, s.zz}}; }

/// The stresses of all tets, and for each at least the magnitude of its traction on any plane [Pa]: sixteen of these
/// fit where one stress does. Minus infinity where a tet sleeps: none of its facets is overloaded.
struct TetStresses {
  std::span<const TetStress> stress;
  std::span<const float> bound;
};

/// Traction [Pa] that a stress exerts on a plane with unit normal n.
inline Vec3 traction(const TetStress& s, const Vec3& n) {
  return {s.xx * n.x() + s.xy * n.y() + s.zx * n.z(), s.xy * n.x() + s.yy * n.y() + s.yz * n.z(),
          s.zx * n.x() + s.yz * n.y() + s.zz * n.z()};
}

/// Traction [Pa] on a facet with unit normal n, from the mean stress of its two tets.
inline Vec3 facet_traction(const TetStress& minus, const TetStress& plus, const Vec3& n) {
  return 0.5 * (traction(minus, n) + traction(plus, n));
}

}  // namespace knap
