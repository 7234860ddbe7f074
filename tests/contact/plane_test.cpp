#include "contact/plane.hpp"

#include <gtest/gtest.h>

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

TEST(Plane, LandsANodeExactlyOnTheSurface) {
  NodalState nodes = one_node({0, 0, 1e-4}, {0, 0, -1});
  const ToolAction action = apply_plane({}, nodes, dt);
  EXPECT_NEAR(nodes.x[0].z() + dt * nodes.v[0].z(), 0.0, 1e-18);  // round-off of 1e-4
  EXPECT_NEAR(action.impulse.z(), 2.0 * (1.0 - 0.1), 1e-12);
}

TEST(Plane, LeavesANodeThatDoesNotReachIt) {
  NodalState nodes = one_node({0, 0, 1e-2}, {1, 0, -1});
  EXPECT_TRUE(apply_plane({}, nodes, dt).nodes.empty());
  EXPECT_EQ(nodes.v[0], Vec4(1, 0, -1, 0));
}

TEST(Plane, SticksInsideTheFrictionConeAndSlidesOnIt) {
  const Plane plane{.friction = 0.5};
  NodalState sticks = one_node({0, 0, 0}, {0.4, 0, -1});
  apply_plane(plane, sticks, dt);
  EXPECT_EQ(sticks.v[0].x(), 0.0);
  NodalState slides = one_node({0, 0, 0}, {0.8, 0.6, -1});
  apply_plane(plane, slides, dt);
  EXPECT_NEAR(slides.v[0].head<2>().norm(), 0.5, 1e-15);  // 1 - mu x 1
  EXPECT_NEAR(slides.v[0].y() / slides.v[0].x(), 0.75, 1e-15);
}

TEST(Plane, LossesAreTheKineticEnergyTaken) {
  NodalState nodes = one_node({0, 0, 0}, {3, 0, -2});
  const double before = kinetic_energy(nodes);
  const ToolAction action = apply_plane({.friction = 0.3}, nodes, dt);
  EXPECT_NEAR(action.impact_loss + action.friction_loss, before - kinetic_energy(nodes), 1e-14);
  EXPECT_GT(action.friction_loss, 0.0);
}

}  // namespace
}  // namespace knap
