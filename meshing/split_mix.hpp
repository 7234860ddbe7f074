#pragma once
#include <cmath>
#include <cstdint>

#include "core/types.hpp"

namespace knap {

/// Steele, Lea & Flood (2014), splitmix64: a small generator with the same numbers on every platform, which the
/// distributions of the standard library do not promise.
struct SplitMix {
  std::uint64_t state;

  std::uint64_t next() {
    std::uint64_t z = (state += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }
  /// Uniform in [0, 1).
  double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }
};

/// A point uniform in the unit ball.
inline Vec3 random_in_unit_ball(SplitMix& random) {
  for (;;) {
    const double x = 2.0 * random.uniform() - 1.0;
    const double y = 2.0 * random.uniform() - 1.0;
    const double z = 2.0 * random.uniform() - 1.0;
    if (x * x + y * y + z * z <= 1.0) return {x, y, z};
  }
}

/// A rotation uniform over all rotations: a uniform unit quaternion, by rejection.
inline Mat3 random_rotation(SplitMix& random) {
  for (;;) {
    Vec4 q;
    for (int k = 0; k < 4; ++k) q[k] = 2.0 * random.uniform() - 1.0;
    const double norm2 = q.squaredNorm();
    if (norm2 > 0.01 && norm2 <= 1.0) return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
  }
}

}  // namespace knap
