#pragma once
#include <cstdint>

#include "core/types.hpp"

namespace knap {

/// The next state of splitmix64 (Steele, Lea & Flood 2014) mixed to 64 random bits: the same on every platform, which
/// the distributions of the standard library do not promise.
inline std::uint64_t splitmix64(std::uint64_t& state) {
  state += 0x9e3779b97f4a7c15ULL;
  std::uint64_t z = state;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

/// A uniform number in (0, 1).
inline double uniform01(std::uint64_t& state) {
  return (static_cast<double>(splitmix64(state) >> 11) + 0.5) * 0x1.0p-53;
}

/// A uniform number in [-1, 1).
inline double uniform_signed(std::uint64_t& state) {
  return static_cast<double>(splitmix64(state) >> 11) * 0x1.0p-52 - 1.0;
}

/// A point uniform in the unit ball.
inline Vec3 random_in_unit_ball(std::uint64_t& state) {
  for (;;) {
    const double x = uniform_signed(state);
    const double y = uniform_signed(state);
    const double z = uniform_signed(state);
    if (x * x + y * y + z * z <= 1.0) return {x, y, z};
  }
}

/// A rotation uniform over all rotations: a uniform unit quaternion, by rejection.
inline Mat3 random_rotation(std::uint64_t& state) {
  for (;;) {
    Vec4 q;
    for (int k = 0; k < 4; ++k) q[k] = uniform_signed(state);
    const double norm2 = q.squaredNorm();
    if (norm2 > 0.01 && norm2 <= 1.0) return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
  }
}

}  // namespace knap
