// Elastic impact of a sphere on a rigid wall against Hertz (physics.md section 3): rho v^2/E* about 1e-4, the mesh
// graded so that the contact radius has five elements.
#include <gtest/gtest.h>

#include <cmath>

#include "simulation/step.hpp"
#include "tests/support/granule.hpp"

namespace knap {
namespace {

TEST(Hertz, ForceDurationAndRestitution) {
  const double speed = 7.0, radius = 1e-3;
  Granule granule{
      .diameter = 2.0 * radius, .element_size = 0.2e-3, .contact_element_size = 0.03e-3, .contact_extent = 0.35e-3};
  granule.options.wall = Plane{};
  granule.options.velocity = {0.0, 0.0, -speed};
  Simulation s = make_granule(granule);
  const double reduced = granule.options.young_modulus / (1.0 - 0.25 * 0.25);
  const double mass = s.reference.start.mass;
  const double approach = std::pow(15.0 * mass * speed * speed / (16.0 * reduced * std::sqrt(radius)), 0.4);
  const double force = 4.0 / 3.0 * reduced * std::sqrt(radius) * std::pow(approach, 1.5);
  const double duration = 2.9433 * approach / speed;

  // The force as the mean over windows of a fiftieth of the contact.
  const int window = static_cast<int>(duration / 50.0 / s.clock.dt);
  double largest = 0.0;
  double impulse_before = 0.0;
  while (s.clock.time() < 1.5 * duration) {
    for (int i = 0; i < window; ++i) ASSERT_EQ(step(s), StepStatus::Ok);
    const double impulse = s.totals.wall.impulse.z();
    largest = std::max(largest, (impulse - impulse_before) / (window * s.clock.dt));
    impulse_before = impulse;
  }
  EXPECT_NEAR(largest / force, 1.0, 0.05);
  EXPECT_NEAR(static_cast<double>(s.totals.last_wall_step - s.totals.first_wall_step) * s.clock.dt / duration, 1.0,
              0.05);
  // Hertz itself keeps the energy; what waves carry off is below 1 % of the speed here (Hunter 1957: about
  // 1.04 (v/c0)^(3/5) of the energy).
  EXPECT_GE(momentum(s.nodes).velocity().z() / speed, 0.99);
  EXPECT_LT(s.ledger.max_closure_error, 1e-4);
}

}  // namespace
}  // namespace knap
