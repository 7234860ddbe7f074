#include "contact/tool_edges.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "contact/repair_surface.hpp"
#include "core/random.hpp"
#include "simulation/make_simulation.hpp"
#include "simulation/step.hpp"
#include "tests/contact/stl_text.hpp"
#include "tests/support/bar_mesh.hpp"

namespace knap {
namespace {

Vec3 random_point(std::uint64_t& random) {
  return {uniform_signed(random), uniform_signed(random), uniform_signed(random)};
}

TEST(PointTree, FindsWhatIsInABoxAndIsNeverTooFar) {
  std::uint64_t random = 1;
  std::vector<Vec3> points;
  for (int i = 0; i < 500; ++i) points.push_back(random_point(random));
  const PointTree tree = make_point_tree(points);
  for (int i = 0; i < 200; ++i) {
    const Vec3 a = 1.5 * random_point(random), b = a + 0.3 * random_point(random);
    const ShapeBox box{a.cwiseMin(b), a.cwiseMax(b)};
    std::size_t inside = 0;
    double nearest = 1e300;
    for (const Vec3& p : points) {
      const double distance = (box.low - p).cwiseMax(p - box.high).cwiseMax(0.0).norm();
      nearest = std::min(nearest, distance);
      inside += distance == 0.0 ? 1 : 0;
    }
    EXPECT_EQ(points_in(tree, box).size(), inside);
    EXPECT_LE(distance_to(tree, box), nearest);
    EXPECT_GE(distance_to(tree, box), nearest - 0.8);  // a leaf's size
  }
}

TEST(EdgePoints, AreOnTheEdgesThatStickOut) {
  const auto on_cube = edge_points(SurfaceTool{repaired_surface(cube_soup(), "cube")}, 0.3);
  EXPECT_EQ(on_cube.size(), 8u + 12u * 3u);
  for (const Vec3& p : on_cube) {
    const auto at_side = [](double x) { return x == 0.0 || x == 1.0; };
    EXPECT_GE(int{at_side(p.x())} + int{at_side(p.y())} + int{at_side(p.z())}, 2) << p.transpose();
  }
  Soup hollow = cube_soup(3.0);
  for (auto triangle : cube_soup()) {
    for (Vec3& x : triangle) x += Vec3::Constant(1.0);
    hollow.push_back(triangle);
  }
  EXPECT_EQ(edge_points(SurfaceTool{repaired_surface(hollow, "box")}, 1.5).size(), 8u + 12u);  // the cavity's point in
  EXPECT_TRUE(edge_points(BallTool{1.0}, 0.1).empty());
  for (const Vec3& p : edge_points(DiscPlaten{2.0, 0.5}, 0.1)) {
    EXPECT_NEAR(std::hypot(p.x(), p.y()), 2.0, 1e-12);
    EXPECT_TRUE(p.z() == 0.0 || p.z() == -0.5);
  }
}

/// A long roof under the plane z = 0, its ridge the y axis, `angle` between its sides.
SurfaceTool roof(double size, double angle) {
  const double half = size * std::tan(0.5 * angle);
  const auto corner = [&](double x, double y, double z) { return Vec3(x * half, y * size, z * size); };
  Soup soup;
  const auto quad = [&](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    soup.push_back({a, b, c});
    soup.push_back({a, c, d});
  };
  quad(corner(0, -1, 0), corner(0, 1, 0), corner(-1, 1, -1), corner(-1, -1, -1));
  quad(corner(0, 1, 0), corner(0, -1, 0), corner(1, -1, -1), corner(1, 1, -1));
  quad(corner(1, -1, -1), corner(-1, -1, -1), corner(-1, 1, -1), corner(1, 1, -1));
  soup.push_back({corner(0, -1, 0), corner(-1, -1, -1), corner(1, -1, -1)});
  soup.push_back({corner(0, 1, 0), corner(1, 1, -1), corner(-1, 1, -1)});
  return {repaired_surface(soup, "roof")};
}

constexpr double cell = 0.1e-3;

/// An elastic block of 6 x 6 x 3 cells above the ridge, which meets it between its nodes.
Simulation block_on_a_ridge(double friction, const Vec3& velocity) {
  TetMesh mesh = bar_mesh({6, 6, 3}, cell);
  for (Vec3& x : mesh.vertices) x += Vec3(-2.6 * cell, -2.9 * cell, 1e-7);
  SimulationOptions options{.young_modulus = 2.45e9, .poisson_ratio = 0.25, .density = 1270.0};
  options.velocity = velocity;
  ToolOptions tool;
  tool.shape = roof(2e-3, 0.5);
  tool.friction = friction;
  options.tools = {tool};
  return make_simulation(options, mesh);
}

double deepest(const Simulation& s) {
  double depth = 0.0;
  for (int k = 0; k <= 100; ++k) {
    const Vec3 p(0.0, (-2.4 + 0.048 * k) * cell, 0.0);  // on the ridge
    for (const TetCorners& nodes : s.topology.tet_nodes) {
      double least = 1e300;  // depth below the tet's faces
      for (const auto& face : facet_of_corner) {
        const auto x = [&](std::size_t i) -> Vec3 { return xyz(s.nodes.x[at(nodes[at(face[i])])]); };
        const Vec3 normal = (x(1) - x(0)).cross(x(2) - x(0)).normalized();
        least = std::min(least, -normal.dot(p - x(0)));
      }
      depth = std::max(depth, least);
    }
  }
  return depth;
}

TEST(ToolEdges, ARidgeDoesNotCutThroughABlockBetweenItsNodes) {
  Simulation s = block_on_a_ridge(0.0, {0, 0, -5});
  double depth = 0.0;
  while (s.clock.time() < 2e-6) {
    ASSERT_EQ(step(s), StepStatus::Ok);
    if (s.clock.step % 10 == 0) depth = std::max(depth, deepest(s));
  }
  EXPECT_GT(s.tools[0].state.impulse.z(), 0.0);
  EXPECT_GT(momentum(s.nodes).velocity().z(), 0.0);  // thrown back; 10 um in that time without contact
  EXPECT_LT(depth, 0.02 * cell);
  EXPECT_GT(depth, 0.0);
  EXPECT_LT(s.ledger.max_closure_error, 1e-4);
  EXPECT_LT(s.tools[0].state.impact_loss, 0.1 * s.reference.incident_energy);
  const Vec3 balance = momentum(s.nodes).linear - s.reference.start.linear - s.tools[0].state.impulse;
  EXPECT_NEAR(balance.norm(), 0.0, 1e-12 * s.reference.start.linear.norm());
  const Vec3 angular = momentum(s.nodes).angular - s.reference.start.angular - s.tools[0].state.angular_impulse;
  EXPECT_NEAR(angular.norm(), 0.0, 1e-12 * s.reference.start.linear.norm() * cell);
}

TEST(ToolEdges, ARidgeRubsAlongABlock) {
  Simulation s = block_on_a_ridge(0.3, {0, 20, -5});  // fast enough never to stick
  while (s.clock.time() < 2e-6) ASSERT_EQ(step(s), StepStatus::Ok);
  const ToolState& tool = s.tools[0].state;
  EXPECT_NEAR(tool.impulse.y(), -0.3 * tool.impulse.z(), 0.02 * tool.impulse.z());
  EXPECT_GT(tool.friction_loss, 0.0);
  EXPECT_LT(s.ledger.max_closure_error, 1e-4);
}

// Looking again only where something may have come near finds the same as looking everywhere.
TEST(ToolEdges, TheWatchMissesNothing) {
  Simulation s = block_on_a_ridge(0.3, {1, 2, -5});
  std::size_t compared = 0;
  while (s.clock.time() < 1e-6) {
    Simulation fresh = s;
    fresh.tool_edges = make_edge_watch(s.tools, 0.4 * s.reference.mean_edge);
    watch_free_faces(fresh.tool_edges, s.topology);
    ASSERT_EQ(step(s), StepStatus::Ok);
    ASSERT_EQ(step(fresh), StepStatus::Ok);
    EXPECT_EQ(s.nodes_on_tools, fresh.nodes_on_tools);
    EXPECT_EQ(s.nodes.v, fresh.nodes.v);
    compared += s.nodes_on_tools.size();
  }
  EXPECT_GT(compared, 0u);
}

}  // namespace
}  // namespace knap
