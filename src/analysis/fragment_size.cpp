#include "analysis/fragment_size.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace knap {
namespace {

/// Length [m] of the points' shadow on a unit direction.
double width(std::span<const Vec3> points, const Vec3& direction) {
  double low = std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::lowest();
  for (const Vec3& p : points) {
    const double s = p.dot(direction);
    low = std::min(low, s);
    high = std::max(high, s);
  }
  return points.empty() ? 0.0 : high - low;
}

/// Side [m] of the smallest square around the points' shadow along p x q.
double smallest_square(std::span<const Vec3> points, const Vec3& p, const Vec3& q) {
  constexpr int num_angles = 90;
  double smallest = std::numeric_limits<double>::max();
  for (int k = 0; k < num_angles; ++k) {
    const double angle = k * std::numbers::pi / (2 * num_angles);
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const double first = width(points, c * p + s * q);
    if (first >= smallest) continue;
    smallest = std::min(smallest, std::max(first, width(points, c * q - s * p)));
  }
  return smallest;
}

}  // namespace

Vec3 extents(std::span<const Vec3> points, const Mat3& axes) {
  return {width(points, axes.col(0)), width(points, axes.col(1)), width(points, axes.col(2))};
}

double sieve_size(std::span<const Vec3> points, const Mat3& axes) {
  double smallest = std::numeric_limits<double>::max();
  for (int i = 0; i < 3; ++i) {
    smallest = std::min(smallest, smallest_square(points, axes.col((i + 1) % 3), axes.col((i + 2) % 3)));
  }
  return smallest;
}

}  // namespace knap
