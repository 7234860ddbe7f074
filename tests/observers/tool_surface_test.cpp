#include "observers/tool_surface.hpp"

#include <gtest/gtest.h>

#include <map>
#include <numbers>

namespace knap {
namespace {

constexpr double pi = std::numbers::pi;

Tool tool_of(const ToolShape& shape) {
  Tool tool;
  tool.shape = shape;
  tool.state.position = Vec3(0.3, -0.2, 0.1);
  tool.state.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));
  return tool;
}

// By Gauss' theorem: positive where the triangles look outwards.
double enclosed_volume(const DrawnSurface& surface) {
  double volume = 0.0;
  for (const auto& [a, b, c] : surface.triangles)
    volume += surface.points[at(a)].dot(surface.points[at(b)].cross(surface.points[at(c)])) / 6.0;
  return volume;
}

// Every edge is used once in each direction.
bool is_closed(const DrawnSurface& surface) {
  std::map<std::pair<Index, Index>, int> uses;
  for (const auto& [a, b, c] : surface.triangles) ++uses[{a, b}], ++uses[{b, c}], ++uses[{c, a}];
  for (const auto& [edge, n] : uses)
    if (n != 1 || !uses.contains({edge.second, edge.first})) return false;
  return true;
}

TEST(ToolSurface, EnclosesTheSolidAndLooksOutwards) {
  const std::map<double, ToolShape> shapes{{pi * 4.0 * 0.5, DiscPlaten{2.0, 0.5}},
                                           {4.0 / 3.0 * pi * 8.0, BallTool{2.0}},
                                           {pi * 4.0 * 3.0, CylinderTool{2.0, 3.0}}};
  for (const auto& [volume, shape] : shapes) {
    const DrawnSurface surface = tool_surface(tool_of(shape), Vec3::Zero(), 1.0);
    EXPECT_TRUE(is_closed(surface));
    EXPECT_NEAR(enclosed_volume(surface), volume, 0.01 * volume);  // 64 spokes: a circle is 0.16 % short
  }
}

TEST(ToolSurface, ItsPointsAreOnTheTool) {
  for (const ToolShape& shape : {ToolShape(DiscPlaten{2.0, 0.5}), ToolShape(BallTool{2.0}),
                                 ToolShape(CylinderTool{2.0, 3.0}), ToolShape(HalfSpace{})}) {
    const Tool tool = tool_of(shape);
    for (const Vec3& point : tool_surface(tool, Vec3(5, 5, 5), 3.0).points)
      EXPECT_NEAR(proximity(tool, point).gap, 0.0, 1e-12);
  }
}

TEST(ToolSurface, AHalfSpaceIsShownWhereOneLooks) {
  const Tool tool = tool_of(HalfSpace{});
  const Vec3 centre(50, 60, 70);
  const DrawnSurface disc = tool_surface(tool, centre, 3.0);
  const ToolProximity near = proximity(tool, centre);
  for (const Vec3& point : disc.points) EXPECT_LE((point - (centre - near.gap * near.normal)).norm(), 3.0 + 1e-9);
}

}  // namespace
}  // namespace knap
