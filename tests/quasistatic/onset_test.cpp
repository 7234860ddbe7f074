// The run that starts at the onset of fracture, against the one that gets there by itself.
#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "simulation/quasistatic_start.hpp"
#include "simulation/step.hpp"
#include "tests/quasistatic/press.hpp"
#include "tests/support/granule.hpp"

namespace knap {
namespace {

// A granule between a plate at rest and one that comes down.
Simulation pressed_granule(double speed, double friction) {
  static const TetMesh mesh = coarse_sphere();
  const BoundingBox box = bounding_box(mesh);
  SimulationOptions options;
  options.particles = {Granule{}.particle};
  options.particles.front().fracture = zeolite_fracture();
  ToolOptions below = wall(friction, box.low);
  ToolOptions above = wall(friction, box.high, -Vec3::UnitZ());
  above.name = "platen";
  above.motion = ConstantVelocity{{0.0, 0.0, -speed}};
  options.tools = {below, above};
  return make_simulation(options, mesh);
}

double push_below(const Simulation& s, double before) { return (s.tools[0].state.impulse.z() - before) / s.clock.dt; }

// The force, mean over the last 50 steps before a facet opens.
double explicit_onset_force(double speed, double friction) {
  Simulation s = pressed_granule(speed, friction);
  s.options.tools[1].motion = Ramp{{0.0, 0.0, -speed}, 20e-6 / speed};  // gently: a sudden start shakes the particle
  s.tools = make_tools(s.options.tools, s.clock.dt);
  std::vector<double> impulse;
  while (s.totals.inserted_facets == 0) {
    EXPECT_EQ(step(s), StepStatus::Ok);
    impulse.push_back(s.tools[0].state.impulse.z());
  }
  return (impulse.back() - impulse[impulse.size() - 51]) / (50.0 * s.clock.dt);
}

TEST(Onset, ASlowExplicitRunAgrees) {
  const double friction = 0.3;
  Simulation s = pressed_granule(0.5, friction);
  const Onset onset = start_at_onset(s);
  const double fast = explicit_onset_force(0.3, friction);
  const double slow = explicit_onset_force(0.15, friction);
  EXPECT_NEAR(slow, fast, 0.03 * slow);  // slow enough
  EXPECT_NEAR(onset.force, slow, 0.03 * slow);
}

TEST(Onset, TheRunGoesOnWithoutAShock) {
  Simulation s = pressed_granule(0.5, 0.3);
  const Onset onset = start_at_onset(s);
  s.options.particles.front().fracture.reset();  // as it would go on if nothing broke
  for (double& strength : s.reference.facet_strength) strength = 1e12;
  const double kinetic = kinetic_energy(s.nodes);
  EXPECT_NEAR(strain_energy(s.elastic, s.nodes.x), onset.strain_energy, 1e-9 * onset.strain_energy);
  const auto steps = std::span(onset.steps).last<2>();
  const double stiffness = (steps[1].force - steps[0].force) / (steps[1].approach - steps[0].approach);
  double before = 0.0;
  for (int i = 0; i < 400; ++i) {
    before = s.tools[0].state.impulse.z();
    ASSERT_EQ(step(s), StepStatus::Ok);
    const double expected = onset.force + stiffness * 0.5 * s.clock.time();
    EXPECT_NEAR(push_below(s, before), expected, 0.02 * expected) << i;
  }
  EXPECT_LT(kinetic_energy(s.nodes), 2.0 * kinetic);
  EXPECT_LT(s.ledger.max_closure_error, 1e-3);
}

TEST(Onset, OpensTheFirstFacetAtOnce) {
  Simulation s = pressed_granule(0.5, 0.3);
  const Onset onset = start_at_onset(s);
  ASSERT_EQ(step(s), StepStatus::Ok);
  EXPECT_GE(s.totals.inserted_facets, 1);
  EXPECT_NE(s.topology.facet_state[at(onset.facet.facet)], FacetState::Bonded);
}

TEST(Onset, OtherCasesAreRefused) {
  Simulation s = pressed_granule(0.5, 0.3);
  s.options.tools.pop_back();
  EXPECT_THROW(start_at_onset(s), InputError);
  s = pressed_granule(-0.5, 0.3);  // the platen goes away
  EXPECT_THROW(start_at_onset(s), InputError);
  s = pressed_granule(0.5, 0.3);
  s.options.tools[1].motion = Rotation{};
  EXPECT_THROW(start_at_onset(s), InputError);
  s = pressed_granule(0.5, 0.3);
  s.options.particles.front().fracture.reset();
  EXPECT_THROW(start_at_onset(s), InputError);
}

}  // namespace
}  // namespace knap
