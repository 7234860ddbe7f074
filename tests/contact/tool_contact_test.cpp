#include "contact/tool_contact.hpp"

#include <gtest/gtest.h>

#include "loading/tool_options.hpp"
#include "time/central_difference.hpp"

namespace knap {
namespace {

constexpr double dt = 1e-3;

NodalState one_node(const Vec3& x, const Vec3& v) {
  NodalState nodes;
  nodes.x = {padded(x)};
  nodes.v = nodes.v_before = {padded(v)};
  nodes.f = {Vec4::Zero()};
  nodes.mass = {2.0};
  return nodes;
}

// One step of tools made just before it; the nodes are not moved.
std::vector<Tool> act(const std::vector<ToolOptions>& options, NodalState& nodes) {
  std::vector<Tool> tools = make_tools(options, dt);
  aim_tools(tools, options, Vec3::Zero(), 0.0, dt);
  apply_tools(tools, nodes, {.dt = dt, .tolerance = 1e-9});
  return tools;
}

ToolOptions moving_wall(const Vec3& velocity, double friction = 0.0) {
  ToolOptions options = wall(friction);
  options.motion = ConstantVelocity{velocity};
  return options;
}

Vec3 end_of(const NodalState& nodes) { return xyz(nodes.x[0]) + dt * xyz(nodes.v[0]); }

TEST(ToolContact, LandsANodeExactlyOnAWall) {
  NodalState nodes = one_node({0, 0, 1e-4}, {0, 0, -1});
  const auto tools = act({wall()}, nodes);
  EXPECT_NEAR(end_of(nodes).z(), 0.0, 1e-18);  // round-off of 1e-4
  EXPECT_NEAR(tools[0].state.impulse.z(), 2.0 * (1.0 - 0.1), 1e-12);
  EXPECT_NEAR(tools[0].state.max_force, 2.0 * (1.0 - 0.1) / dt, 1e-9);
}

TEST(ToolContact, LeavesANodeThatDoesNotReachIt) {
  NodalState nodes = one_node({0, 0, 1e-2}, {1, 0, -1});
  EXPECT_EQ(act({wall()}, nodes)[0].state.first_step, -1);
  EXPECT_EQ(nodes.v[0], Vec4(1, 0, -1, 0));
}

TEST(ToolContact, SticksInsideTheFrictionConeAndSlidesOnIt) {
  NodalState sticks = one_node({0, 0, 0}, {0.4, 0, -1});
  act({wall(0.5)}, sticks);
  EXPECT_EQ(sticks.v[0].x(), 0.0);
  NodalState slides = one_node({0, 0, 0}, {0.8, 0.6, -1});
  act({wall(0.5)}, slides);
  EXPECT_NEAR(slides.v[0].head<2>().norm(), 0.5, 1e-15);  // 1 - mu x 1
  EXPECT_NEAR(slides.v[0].y() / slides.v[0].x(), 0.75, 1e-15);
}

TEST(ToolContact, LossesAreTheKineticEnergyTaken) {
  NodalState nodes = one_node({0, 0, 0}, {3, 0, -2});
  const double before = kinetic_energy(nodes);
  const ToolState tool = act({wall(0.3)}, nodes)[0].state;
  EXPECT_NEAR(tool.impact_loss + tool.friction_loss, before - kinetic_energy(nodes), 1e-14);
  EXPECT_GT(tool.friction_loss, 0.0);
  EXPECT_EQ(tool.work, 0.0);
}

TEST(ToolContact, AMovingWallCarriesANodeAndItsWorkIsWhatTheNodeGainsAndLoses) {
  NodalState nodes = one_node({0, 0, 0}, {0, 0, 0});
  const ToolState tool = act({moving_wall({0.5, 0, 3}, 0.5)}, nodes)[0].state;
  EXPECT_NEAR((Vec3(xyz(nodes.v[0])) - Vec3(0.5, 0, 3)).norm(), 0.0, 1e-13);  // sticks
  EXPECT_NEAR(tool.work, 2.0 * (3.0 * 3.0 + 0.5 * 0.5), 1e-12);
  EXPECT_NEAR(tool.work - tool.impact_loss - tool.friction_loss, kinetic_energy(nodes), 1e-12);
}

// As in every frame that moves along: the same losses, the same velocity relative to the wall.
TEST(ToolContact, IsTheSameInEveryMovingFrame) {
  const Vec3 frame(2, -1, 5);
  NodalState rest = one_node({0, 0, 0}, {3, 1, -2}), moving = one_node({0, 0, 0}, Vec3(3, 1, -2) + frame);
  const ToolState a = act({wall(0.3)}, rest)[0].state, b = act({moving_wall(frame, 0.3)}, moving)[0].state;
  EXPECT_NEAR((Vec3(xyz(moving.v[0]) - xyz(rest.v[0])) - frame).norm(), 0.0, 1e-12);
  EXPECT_NEAR(a.friction_loss, b.friction_loss, 1e-12);
  EXPECT_NEAR(a.impact_loss, b.impact_loss, 1e-12);
}

// A node that rides on a wall of growing speed is pushed, and nothing is lost.
TEST(ToolContact, RidingOnAnAcceleratingWallLosesNothing) {
  ToolOptions options = wall();
  options.motion = Ramp{{0, 0, 2}, 100.0 * dt};
  std::vector<Tool> tools = make_tools(std::vector{options}, dt);
  NodalState nodes = one_node({0, 0, 0}, {0, 0, 0});
  for (int n = 0; n < 50; ++n) {
    kick(nodes, dt);
    aim_tools(tools, std::vector{options}, Vec3::Zero(), n * dt, dt);
    apply_tools(tools, nodes, {.dt = dt, .step = n, .tolerance = 1e-9});
    drift(nodes, dt);
    move_tools(tools);
    EXPECT_NEAR(nodes.x[0].z(), tools[0].state.position.z(), 1e-15);
  }
  EXPECT_NEAR(tools[0].state.impact_loss, 0.0, 1e-12);
  EXPECT_NEAR(tools[0].state.work, kinetic_energy(nodes), 1e-12);
}

TEST(ToolContact, ANodeFoundInsideIsNotThrownOut) {
  NodalState nodes = one_node({0, 0, -0.1}, {1, 0, -1});
  act({wall()}, nodes);
  EXPECT_NEAR(end_of(nodes).z(), -0.1, 1e-15);
  NodalState leaving = one_node({0, 0, -0.1}, {1, 0, 1});
  EXPECT_EQ(act({wall()}, leaving)[0].state.first_step, -1);
}

/// Two walls that meet in the y axis, each at `angle` to the horizontal: a wedge to fall into.
std::vector<ToolOptions> wedge(double angle, double friction) {
  return {wall(friction, Vec3::Zero(), {std::sin(angle), 0, std::cos(angle)}),
          wall(friction, Vec3::Zero(), {-std::sin(angle), 0, std::cos(angle)})};
}

TEST(ToolContact, ANodeInAWedgeStopsOnBothSides) {
  for (const double angle : {0.35, 0.5, 1.0, 1.4}) {  // steep enough not to slide out
    NodalState nodes = one_node({0, 0, 0}, {0.3, 0.2, -1});
    const auto tools = act(wedge(angle, 0.0), nodes);
    for (const double sign : {1.0, -1.0})
      EXPECT_NEAR(end_of(nodes).dot(Vec3(sign * std::sin(angle), 0, std::cos(angle))), 0.0, 1e-9 * dt) << angle;
    EXPECT_NEAR(nodes.v[0].y(), 0.2, 1e-15);
    const Vec3 impulse = tools[0].state.impulse + tools[1].state.impulse;
    EXPECT_NEAR((impulse - 2.0 * Vec3(-0.3, 0, 1)).norm(), 0.0, 1e-8) << angle;
    EXPECT_NEAR(tools[0].state.impact_loss + tools[1].state.impact_loss, 0.09 + 1.0, 1e-8);
    EXPECT_EQ(tools[0].state.friction_loss + tools[1].state.friction_loss, 0.0);
  }
}

// Along the valley both sides rub: the normal impulses of symmetric walls are m v / (2 cos) each.
TEST(ToolContact, FrictionOfBothSidesSlowsANodeInAWedge) {
  const double angle = 0.7, friction = 0.2;
  NodalState nodes = one_node({0, 0, 0}, {0, 2, -1});
  const auto tools = act(wedge(angle, friction), nodes);
  EXPECT_NEAR(nodes.v[0].y(), 2.0 - friction / std::cos(angle), 0.02);  // their rubbing in z takes a little
  EXPECT_NEAR(tools[0].state.friction_loss, tools[1].state.friction_loss, 1e-12);
  EXPECT_NEAR(tools[0].state.friction_loss + tools[1].state.friction_loss + tools[0].state.impact_loss +
                  tools[1].state.impact_loss,
              5.0 - kinetic_energy(nodes), 1e-12);
}

}  // namespace
}  // namespace knap
