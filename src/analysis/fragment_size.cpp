#include "analysis/fragment_size.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace knap {
namespace {

constexpr int num_angles = 90;  // over a quarter turn, after which a square looks the same

/// Length [m] of the shadow of points on a unit direction, in space or in a plane.
template <class Points, class Direction>
double width(const Points& points, const Direction& direction) {
  double low = std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::lowest();
  for (const auto& p : points) {
    const double s = p.dot(direction);
    low = std::min(low, s);
    high = std::max(high, s);
  }
  return points.empty() ? 0.0 : high - low;
}

/// Unit vectors over the quarter turn.
std::array<Eigen::Vector2d, num_angles> quarter_turn() {
  std::array<Eigen::Vector2d, num_angles> directions;
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const double angle = static_cast<double>(k) * std::numbers::pi / (2 * num_angles);
    directions[k] = {std::cos(angle), std::sin(angle)};
  }
  return directions;
}

/// Side [m] of the smallest square around points of a plane.
double smallest_square(std::span<const Eigen::Vector2d> points) {
  static const auto directions = quarter_turn();
  double smallest = std::numeric_limits<double>::max();
  for (const Eigen::Vector2d& direction : directions) {
    const double first = width(points, direction);
    if (first >= smallest) continue;
    smallest = std::min(smallest, std::max(first, width(points, Eigen::Vector2d(-direction.y(), direction.x()))));
  }
  return smallest;
}

}  // namespace

Vec3 extents(std::span<const Vec3> points, const Mat3& axes) {
  const auto along = [&](int i) { return width(points, Vec3(axes.col(i))); };
  return {along(0), along(1), along(2)};
}

double sieve_size(std::span<const Vec3> points, const Mat3& axes) {
  double smallest = std::numeric_limits<double>::max();
  std::vector<Eigen::Vector2d> shadow(points.size());
  for (int i = 0; i < 3; ++i) {
    const Vec3 p = axes.col((i + 1) % 3);
    const Vec3 q = axes.col((i + 2) % 3);
    std::transform(points.begin(), points.end(), shadow.begin(),
                   [&](const Vec3& point) { return Eigen::Vector2d(p.dot(point), q.dot(point)); });
    smallest = std::min(smallest, smallest_square(shadow));
  }
  return smallest;
}

}  // namespace knap
