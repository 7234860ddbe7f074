#include "loading/motion.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/errors.hpp"
#include "loading/tool_options.hpp"

namespace knap {
namespace {

const ToolPose start{{1, 2, 3}, Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Vec3::UnitX()))};

TEST(Motion, ARampGathersSpeedLinearlyAndKeepsIt) {
  const Ramp ramp{{0, 0, -4}, 0.5};
  EXPECT_EQ(pose_at(ramp, start, -1.0).position, start.position);
  EXPECT_NEAR(pose_at(ramp, start, 0.25).position.z(), 3.0 - 0.25, 1e-15);  // half the speed reached, a quarter of 1 s
  EXPECT_NEAR(pose_at(ramp, start, 0.5).position.z(), 3.0 - 1.0, 1e-15);
  EXPECT_NEAR(pose_at(ramp, start, 1.5).position.z(), 3.0 - 5.0, 1e-15);
}

TEST(Motion, ARotationKeepsTheRadiusAndComesBack) {
  const double rate = 2.0 * std::numbers::pi * 300.0;  // 18,000 rpm
  const Rotation rotation{{0, 0, 5}, {0, 0, 2}, rate};
  for (const double turns : {0.25, 1.0, 1000.0}) {
    const ToolPose pose = pose_at(rotation, start, turns / 300.0);
    EXPECT_NEAR((pose.position - Vec3(0, 0, 5)).norm(), (start.position - Vec3(0, 0, 5)).norm(), 1e-12);
    if (turns >= 1.0) {
      EXPECT_NEAR((pose.position - start.position).norm(), 0.0, 1e-9);
    } else {
      EXPECT_NEAR((pose.position - Vec3(-2, 1, 3)).norm(), 0.0, 1e-12);  // a quarter turn about z
    }
  }
  const Vec3 axis = pose_at(rotation, start, 0.25 / 300.0).orientation * Vec3::UnitZ();
  EXPECT_NEAR((axis - Vec3(std::sin(0.3), 0, std::cos(0.3))).norm(), 0.0, 1e-12);
}

TEST(Motion, ToolsHaveTheVelocityOfTheirMotion) {
  const double dt = 1e-7, rate = 1885.0;
  ToolOptions pin;
  pin.shape = CylinderTool{1e-3, 1e-2};
  pin.position = {0.05, 0, 0};
  pin.motion = Rotation{Vec3::Zero(), Vec3::UnitZ(), rate};
  auto tools = make_tools(std::vector{pin}, dt);
  for (int step = 0; step < 100; ++step) {
    aim_tools(tools, std::vector{pin}, Vec3::Zero(), step * dt, dt);
    const ToolState& state = tools[0].state;
    const Vec3 exact = Vec3(0, 0, rate).cross(state.position);
    EXPECT_NEAR((state.velocity - exact).norm(), 0.5 * rate * rate * 0.05 * dt, 1e-4);  // half a step later
    EXPECT_NEAR((state.spin - Vec3(0, 0, rate)).norm(), 0.0, 1e-6 * rate);
    move_tools(tools);
  }
}

template <class Change>
std::string complaint(Change&& change) {
  ToolOptions options;
  options.name = "anvil";
  change(options);
  try {
    make_tools(std::vector{options}, 1.0);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ToolOptions, NonsenseIsRefusedByName) {
  EXPECT_EQ(complaint([](ToolOptions&) {}), "");
  EXPECT_EQ(complaint([](ToolOptions& o) { o.shape = BallTool{0.0}; }), "tool 'anvil': the radius must be above 0");
  EXPECT_NE(complaint([](ToolOptions& o) { o.shape = DiscPlaten{1.0, -1.0}; }), "");
  EXPECT_NE(complaint([](ToolOptions& o) { o.shape = CylinderTool{1.0, 0.0}; }), "");
  EXPECT_NE(complaint([](ToolOptions& o) { o.friction = -0.1; }), "");
  EXPECT_NE(complaint([](ToolOptions& o) { o.position.x() = std::nan(""); }), "");
  EXPECT_NE(complaint([](ToolOptions& o) { o.motion = Ramp{{1, 0, 0}, 0.0}; }), "");
  EXPECT_NE(complaint([](ToolOptions& o) { o.motion = Rotation{Vec3::Zero(), Vec3::Zero(), 1.0}; }), "");
  EXPECT_NE(complaint([](ToolOptions& o) { o.motion = Guided{-Vec3::UnitZ(), 1.0, 0.0}; }), "");
}

}  // namespace
}  // namespace knap
