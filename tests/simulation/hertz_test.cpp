// Elastic impact of a sphere on a rigid frictionless wall (physics.md section 3). Hertz's law is the limit of small
// contacts, not the answer at a finite one. At rho v^2/E* = 1e-4 the contact radius is 0.21 R, and for a Poisson ratio
// of 0.25 the converged answer is 6.7 % above his force and 4.3 % below his duration. Of that the sphere being no half
// space is +11.1 and -7.4 %, inertia -1.3 and +1.1 %, finite strain -3.1 and +2.0 %; all grow with the contact radius.
// So the law is checked at 1e-6 (2.5 and -1.9 %), and 1e-4 against an independent solution of the same problem.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "simulation/step.hpp"
#include "tests/simulation/axisymmetric_impact.hpp"
#include "tests/support/granule.hpp"

namespace knap {
namespace {

constexpr double poisson_ratio = 0.25;

// The sphere of tets: elements of a fifth of the contact radius as far as 2.4 of these from the pole, a seventh of R at
// the far end.
ImpactOverHertz impact_of_tets(double group) {
  const double radius = 1e-3, contact_radius = radius * std::pow(1.25 * std::numbers::pi * group, 0.2);
  Granule granule{.diameter = 2.0 * radius,
                  .element_size = 0.14 * radius,
                  .contact_element_size = 0.2 * contact_radius,
                  .contact_extent = 2.4 * contact_radius};
  const double reduced = granule.particle.young_modulus / (1.0 - poisson_ratio * poisson_ratio);
  const double speed = std::sqrt(group * reduced / granule.particle.density);
  granule.particle.poisson_ratio = poisson_ratio;
  granule.options.tools = {wall()};
  granule.options.step_safety = 0.8;
  granule.particle.velocity = {0.0, 0.0, -speed};
  Simulation s = make_granule(granule);
  const double mass = s.reference.start.mass;
  const double approach = std::pow(15.0 * mass * speed * speed / (16.0 * reduced * std::sqrt(radius)), 0.4);
  const double force = 4.0 / 3.0 * reduced * std::sqrt(radius) * std::pow(approach, 1.5);
  const double duration = 2.9433 * approach / speed;
  while (s.clock.time() < 1.25 * duration)
    if (step(s) != StepStatus::Ok) return {};
  EXPECT_LT(s.ledger.max_closure_error, 1e-6);
  const ToolState& wall = s.tools[0].state;
  const auto steps_on_wall = static_cast<double>(wall.last_step - wall.first_step);
  return {wall.max_force / force, steps_on_wall * s.clock.dt / duration, momentum(s.nodes).velocity().z() / speed};
}

ImpactOverHertz axisymmetric_impact(double group, bool small_strain = false) {
  return AxisymmetricSphere({.group = group, .poisson_ratio = poisson_ratio, .small_strain = small_strain}).run();
}

TEST(Hertz, ForceDurationAndRestitutionOfASmallContact) {
  const ImpactOverHertz impact = impact_of_tets(1e-6);
  EXPECT_NEAR(impact.force, 1.0, 0.05);
  EXPECT_NEAR(impact.duration, 1.0, 0.05);
  EXPECT_GE(impact.restitution, 0.99);
}

// 1 % is the error of these meshes, half of it from the far end: with all sizes halved the force is within 0.1 %, the
// duration within 0.2 %.
TEST(Hertz, LargerContactIsTheAxisymmetricSolution) {
  const ImpactOverHertz impact = impact_of_tets(1e-4), reference = axisymmetric_impact(1e-4);
  EXPECT_NEAR(impact.force / reference.force, 1.0, 0.01);
  EXPECT_NEAR(impact.duration / reference.duration, 1.0, 0.01);
  EXPECT_NEAR(impact.restitution, reference.restitution, 1e-3);
}

// Deviations grow as the contact radius, the fifth root of the group: what is left at none, whatever the law of the
// material. The meshes' errors of 0.2 % count 2.3 times here.
TEST(Hertz, AxisymmetricSolutionTendsToIt) {
  for (const bool small_strain : {false, true}) {
    const ImpactOverHertz large = axisymmetric_impact(1e-4, small_strain);
    const ImpactOverHertz small = axisymmetric_impact(1e-6, small_strain);
    const double ratio = std::pow(100.0, 0.2);
    EXPECT_NEAR((ratio * small.force - large.force) / (ratio - 1.0), 1.0, 0.01);
    EXPECT_NEAR((ratio * small.duration - large.duration) / (ratio - 1.0), 1.0, 0.01);
  }
}

}  // namespace
}  // namespace knap
