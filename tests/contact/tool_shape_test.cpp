// Distances against the nearest of many points of the surface.
#include "contact/tool_shape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "contact/tool.hpp"
#include "core/random.hpp"

namespace knap {
namespace {

constexpr int fine = 300;  // points along a length of 1

using Points = std::vector<Vec3>;

void add_ring(Points& points, double radius, double z) {
  const int count = std::max(1, static_cast<int>(2.0 * std::numbers::pi * radius * fine));
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / count;
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
  }
}

Points capped_cylinder(double radius, double low, double high) {
  Points points;
  const int rings = static_cast<int>(radius * fine), levels = static_cast<int>((high - low) * fine);
  for (const double z : {low, high})
    for (int i = 0; i <= rings; ++i) add_ring(points, radius * i / rings, z);
  for (int i = 0; i <= levels; ++i) add_ring(points, radius, low + (high - low) * i / levels);
  return points;
}

Points ball(double radius) {
  Points points;
  for (int i = 0; i <= fine; ++i) {
    const double polar = std::numbers::pi * i / fine;
    add_ring(points, radius * std::sin(polar), radius * std::cos(polar));
  }
  return points;
}

double nearest(const Points& points, const Vec3& to) {
  double best = 1e300;
  for (const Vec3& point : points) best = std::min(best, (point - to).norm());
  return best;
}

template <class Shape, class Inside>
void compare(const Shape& shape, const Points& surface, Inside&& inside) {
  std::uint64_t random = 7;
  const auto uniform = [&random] { return 2.0 * static_cast<double>(splitmix64(random) >> 11) * 0x1p-53 - 1.0; };
  for (int i = 0; i < 100; ++i) {
    const Vec3 point(uniform(), uniform(), uniform());
    const SurfaceDistance distance = surface_distance(shape, point);
    const double expected = nearest(surface, point) * (inside(point) ? -1.0 : 1.0);
    EXPECT_NEAR(distance.gap, expected, 3e-3) << point.transpose();  // half the spacing, at small distances
    EXPECT_NEAR(distance.normal.norm(), 1.0, 1e-14);
    EXPECT_NEAR(surface_distance(shape, point - distance.gap * distance.normal).gap, 0.0, 1e-14);
    const ShapeBox box = bounding_box(shape);
    const bool in_box = ((point - box.low).array() >= 0.0).all() && ((box.high - point).array() >= 0.0).all();
    EXPECT_TRUE(in_box || !inside(point));
  }
}

TEST(ToolShape, DistancesAreThoseToTheSurface) {
  compare(BallTool{0.6}, ball(0.6), [](const Vec3& p) { return p.norm() < 0.6; });
  const auto in_disc = [](const Vec3& p) { return std::hypot(p.x(), p.y()) < 0.7 && p.z() < 0.0 && p.z() > -0.3; };
  compare(DiscPlaten{0.7, 0.3}, capped_cylinder(0.7, -0.3, 0.0), in_disc);
  const auto in_pin = [](const Vec3& p) { return std::hypot(p.x(), p.y()) < 0.4 && std::abs(p.z()) < 0.55; };
  compare(CylinderTool{0.4, 1.1}, capped_cylinder(0.4, -0.55, 0.55), in_pin);
}

TEST(ToolShape, HasANormalEverywhereOnTheAxis) {
  for (const double z : {-1.0, -0.1, 0.0, 0.1, 1.0}) {
    const Vec3 point(0, 0, z);
    EXPECT_NEAR(surface_distance(BallTool{0.5}, point).normal.norm(), 1.0, 1e-15);
    EXPECT_NEAR(surface_distance(CylinderTool{0.5, 0.4}, point).normal.norm(), 1.0, 1e-15);
    EXPECT_NEAR(surface_distance(DiscPlaten{0.5, 0.4}, point).normal.norm(), 1.0, 1e-15);
  }
}

TEST(ToolShape, ProximityIsInTheWorldAndKnowsTheSurfacesVelocity) {
  Tool tool;
  tool.shape = CylinderTool{0.5, 2.0};
  tool.state.position = {1, 2, 3};
  tool.state.orientation =
      Eigen::Quaterniond(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitY()));  // axis along x
  tool.state.velocity = {0, 0, 7};
  tool.state.spin = {10, 0, 0};
  const ToolProximity side = proximity(tool, {1.5, 2.0, 4.0});
  EXPECT_NEAR(side.gap, 0.5, 1e-14);
  EXPECT_NEAR((side.normal - Vec3(0, 0, 1)).norm(), 0.0, 1e-14);
  EXPECT_NEAR((side.velocity - Vec3(0, -5, 7)).norm(), 0.0, 1e-13);  // spin x (0, 0, 0.5)
  EXPECT_NEAR(proximity(tool, {2.25, 2.0, 3.0}).gap, 0.25, 1e-14);
}

}  // namespace
}  // namespace knap
