// Whole steps with tools and gravity, against formulas.
#include <gtest/gtest.h>

#include <numbers>

#include "contact/repair_surface.hpp"
#include "core/errors.hpp"
#include "simulation/make_simulation.hpp"
#include "simulation/step.hpp"
#include "tests/contact/stl_text.hpp"
#include "tests/support/bar_mesh.hpp"
#include "tests/support/granule.hpp"

namespace knap {
namespace {

constexpr double g = 9.81;

/// A soft block of 20 mm on a wall inclined by `angle`, under gravity; damped, so that it comes to rest.
Simulation block_on_incline(double angle, double friction) {
  TetMesh mesh = bar_mesh({2, 2, 2}, 0.01);
  SimulationOptions options{.young_modulus = 1e6, .poisson_ratio = 0.25, .density = 1000.0};
  options.viscous_ratio = 0.5;
  options.relaxation_time = 2e-3;
  options.tools = {wall(friction)};
  options.gravity = g * Vec3(std::sin(angle), 0, -std::cos(angle));
  return make_simulation(options, mesh);
}

void run_to(Simulation& s, double time) {
  while (s.clock.time() < time) ASSERT_EQ(step(s), StepStatus::Ok);
}

TEST(Incline, ABlockSticksBelowTheAngleOfFriction) {
  const double friction = 0.5;
  Simulation s = block_on_incline(0.9 * std::atan(friction), friction);
  run_to(s, 0.1);  // settles
  const double before = momentum(s.nodes).centre().x();
  run_to(s, 0.3);
  const double slid = 0.5 * g * std::sin(0.9 * std::atan(friction)) * 0.2 * 0.2;
  EXPECT_NEAR(momentum(s.nodes).centre().x(), before, 1e-5 * slid);
}

TEST(Incline, ABlockSlidesWithTheAccelerationThatFrictionLeaves) {
  const double friction = 0.3, angle = 0.6;
  Simulation s = block_on_incline(angle, friction);
  run_to(s, 0.1);
  const double speed = momentum(s.nodes).velocity().x(), start = s.clock.time();
  run_to(s, 0.3);
  const double acceleration = (momentum(s.nodes).velocity().x() - speed) / (s.clock.time() - start);
  EXPECT_NEAR(acceleration, g * (std::sin(angle) - friction * std::cos(angle)), 2e-3 * g);
  EXPECT_LT(s.ledger.closure_error(), 1e-6);  // of what gravity has supplied by now
  const Vec3 balance = momentum(s.nodes).linear - s.totals.gravity.linear - s.tools[0].state.impulse;
  EXPECT_NEAR(balance.norm(), 0.0, 1e-12 * s.totals.gravity.linear.norm());
}

TEST(Gravity, AFallingBodyTurnsPotentialIntoKineticEnergyExactly) {
  SimulationOptions options{.young_modulus = 1e6, .poisson_ratio = 0.25, .density = 1000.0};
  options.gravity = {0, 0, -g};
  options.velocity = {1, 0, 2};
  options.spin = {0, 30, 0};
  Simulation s = make_simulation(options, bar_mesh({1, 1, 2}, 0.01));
  const Vec3 centre = momentum(s.nodes).centre();
  run_to(s, 0.2);
  const double t = s.clock.time();  // the first kick comes at time 0: the start is half a step earlier
  const Vec3 way = t * options.velocity + 0.5 * t * (t + s.clock.dt) * options.gravity;
  EXPECT_NEAR((momentum(s.nodes).centre() - centre - way).norm(), 0.0, 1e-9);
  EXPECT_LT(s.ledger.max_closure_error, 1e-6);
  EXPECT_NEAR((momentum(s.nodes).angular - s.reference.start.angular - s.totals.gravity.angular).norm(), 0.0, 1e-9);
}

/// A coarse elastic zeolite sphere of 1.5 mm, its lowest node 1 nm above z = 0.
Granule small_granule() { return {.element_size = 0.3e-3, .contact_element_size = 0.3e-3}; }

TEST(Platen, PressingASphereDoesTheWorkThatTheSphereGains) {
  Granule granule = small_granule();
  const TetMesh mesh = granule_mesh(granule);
  ToolOptions platen;
  platen.name = "platen";
  platen.shape = DiscPlaten{1e-3, 0.5e-3};
  platen.position.z() = bounding_box(mesh).high.z() + 1e-9;
  platen.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX()));  // face down
  platen.motion = Ramp{{0, 0, -3}, 2e-6};
  granule.options.tools = {wall(0.2), platen};
  Simulation s = make_simulation(granule.options, mesh);
  run_to(s, 12e-6);
  const double work = -s.ledger[EnergyTerm::ToolWork];
  EXPECT_GT(work, 1e-6);
  const double gained = s.ledger[EnergyTerm::Kinetic] + s.ledger[EnergyTerm::Strain];
  const double lost = s.ledger[EnergyTerm::ToolFriction] + s.ledger[EnergyTerm::ToolImpact];
  EXPECT_NEAR(gained + lost, work, 1e-6 * work);
  EXPECT_LT(lost, 1e-3 * work);
  EXPECT_LT(s.ledger.max_closure_error, 1e-6);
  EXPECT_GT(s.tools[0].state.impulse.z(), 0.0);
  EXPECT_LT(s.tools[1].state.impulse.z(), 0.0);
}

TEST(Pin, OfARotorNeverHasANodeInside) {
  Granule granule = small_granule();
  const TetMesh mesh = granule_mesh(granule);
  const double rate = 2.0 * std::numbers::pi * 300.0;  // 18,000 rpm at 50 mm: 94 m/s
  ToolOptions pin;
  pin.name = "pin";
  pin.shape = CylinderTool{1e-3, 10e-3};
  pin.position = {-1.80e-3, 0, 0.75e-3};
  pin.friction = 0.3;
  pin.motion = Rotation{pin.position - 0.05 * Vec3::UnitX() + Vec3(0.05, -0.05, 0), Vec3::UnitZ(), -rate};
  granule.options.tools = {pin};
  Simulation s = make_simulation(granule.options, mesh);
  double deepest = 0.0;
  while (s.clock.time() < 5e-6) {
    ASSERT_EQ(step(s), StepStatus::Ok);
    for (const Vec4& x : s.nodes.x) deepest = std::max(deepest, -proximity(s.tools[0], xyz(x)).gap);
  }
  EXPECT_LT(deepest, 1e-6 * 1e-3);
  EXPECT_GT(s.tools[0].state.impulse.x(), 0.0);
  EXPECT_LT(s.ledger.max_closure_error, 1e-3);
  const Vec3 balance = momentum(s.nodes).linear - s.tools[0].state.impulse;
  EXPECT_NEAR(balance.norm(), 0.0, 1e-12 * s.tools[0].state.impulse.norm());
}

// A weight of twenty particles falls on a sphere that lies on a wall, and is thrown back.
TEST(DropWeight, BouncesWithMomentumAndEnergyKept) {
  Granule granule = small_granule();
  const TetMesh mesh = granule_mesh(granule);
  const double mass = 20.0 * 1270.0 * volume(mesh), speed = 2.0;
  ToolOptions weight;
  weight.name = "weight";
  weight.shape = DiscPlaten{1e-3, 1e-3};
  weight.position.z() = bounding_box(mesh).high.z() + 1e-6;
  weight.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX()));
  weight.motion = Guided{-Vec3::UnitZ(), speed, mass};
  granule.options.tools = {wall(), weight};
  granule.options.gravity = {0, 0, -1e4};  // large, to be seen in 60 us
  Simulation s = make_simulation(granule.options, mesh);
  const double start = s.tools[1].state.position.z();
  double lowest = start;
  while (s.clock.time() < 100e-6 && (s.clock.step < 100 || s.tools[1].state.position.z() < start)) {
    ASSERT_EQ(step(s), StepStatus::Ok);
    lowest = std::min(lowest, s.tools[1].state.position.z());
  }
  const ToolState& tool = s.tools[1].state;
  EXPECT_LT(lowest, start - 10e-6);
  EXPECT_GT(tool.velocity.z(), 0.7 * speed);  // thrown back
  const double expected = mass * (-speed - 1e4 * s.clock.time()) - tool.impulse.z();
  EXPECT_NEAR(mass * tool.velocity.z(), expected, 1e-9 * mass * speed);
  EXPECT_LT(s.ledger.max_closure_error, 1e-3);
}

/// A box of triangles about the platen's place: a sphere pressed by it must not know the difference.
TEST(SurfaceTool, AnStlBlockPressesAsAPlatenDoes) {
  const auto pressed = [](bool by_triangles) {
    Granule granule = small_granule();
    const TetMesh mesh = granule_mesh(granule);
    ToolOptions platen;
    platen.shape = DiscPlaten{1e-3, 0.5e-3};
    if (by_triangles) {
      Soup block = cube_soup(2e-3);
      for (auto& triangle : block)
        for (Vec3& x : triangle) x -= Vec3(1e-3, 1e-3, 2e-3);
      platen.shape = SurfaceTool{repaired_surface(block, "block")};
    }
    platen.position.z() = bounding_box(mesh).high.z() + 1e-9;
    platen.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX()));
    platen.motion = ConstantVelocity{{0, 0, -3}};
    granule.options.tools = {wall(0.2), platen};
    Simulation s = make_simulation(granule.options, mesh);
    run_to(s, 3e-6);
    return s.tools[1].state;
  };
  const ToolState platen = pressed(false), block = pressed(true);
  EXPECT_LT(platen.impulse.z(), 0.0);
  EXPECT_NEAR((block.impulse - platen.impulse).norm(), 0.0, 1e-9 * platen.impulse.norm());
  EXPECT_NEAR(block.work, platen.work, 1e-9 * platen.work);
}

TEST(ToolPlacement, AToolInsideTheParticleIsRefusedWithNameAndDepth) {
  Granule granule = small_granule();
  ToolOptions ball;
  ball.name = "ball";
  ball.shape = BallTool{0.2e-3};
  ball.position = {0, 0, -0.1e-3};  // its top 0.1 mm above the lowest node
  granule.options.tools = {ball};
  const auto refusal = [&] {
    try {
      make_granule(granule);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(refusal().find("tool 'ball': the particle starts 0.1 mm inside it"), std::string::npos) << refusal();
  granule.options.tools[0].shape = BallTool{1e-6};
  granule.options.tools[0].position = {0.02e-3, 0.01e-3, 0.75e-3};
  EXPECT_NE(refusal().find("tool 'ball': it starts inside the particle"), std::string::npos) << refusal();
  granule.options.tools[0].position = {0, 0, -0.2e-3};
  EXPECT_EQ(refusal(), "");
}

}  // namespace
}  // namespace knap
