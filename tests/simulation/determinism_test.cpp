#include <gtest/gtest.h>

#include "core/parallel.hpp"
#include "simulation/persistent_arrays.hpp"
#include "simulation/step.hpp"
#include "tests/support/granule.hpp"

namespace knap {
namespace {

Simulation breaking_granule(double viscous_ratio = 0.0) {
  Granule granule{.element_size = 0.2e-3, .contact_element_size = 0.15e-3};
  granule.particle.fracture = zeolite_fracture();
  granule.options.tools = {wall(0.3)};
  granule.particle.velocity = {10.0, 0.0, -28.0};
  granule.particle.viscous_ratio = viscous_ratio;
  granule.particle.relaxation_time = 2e-6;
  return make_granule(granule);
}

void advance(Simulation& s, int steps) {
  for (int i = 0; i < steps; ++i) ASSERT_EQ(step(s), StepStatus::Ok);
}

constexpr int steps = 420;

TEST(Determinism, SameBitsForAnyNumberOfThreads) {
  std::string expected;
  for (const int threads : {1, 2, 3, 8}) {
    set_num_threads(threads);
    Simulation s = breaking_granule();
    advance(s, steps);
    EXPECT_GT(s.contact.fragments, 5);
    if (expected.empty()) expected = state_hash(s);
    EXPECT_EQ(state_hash(s), expected) << threads << " threads";
  }
  set_num_threads(0);
}

TEST(Determinism, SameBitsAcrossACheckpoint) {
  for (const double viscous_ratio : {0.0, 0.3}) {
    Simulation whole = breaking_granule(viscous_ratio);
    advance(whole, steps);
    Simulation first = breaking_granule(viscous_ratio);
    advance(first, steps - 131);
    const Checkpoint checkpoint = make_checkpoint(first);
    Simulation second = breaking_granule(viscous_ratio);
    restore_checkpoint(second, checkpoint);
    EXPECT_EQ(state_hash(second), state_hash(first));
    advance(second, 131);
    EXPECT_EQ(state_hash(second), state_hash(whole));
  }
}

TEST(Determinism, TheHashSeesOneBit) {
  Simulation s = breaking_granule();
  const std::string before = state_hash(s);
  s.nodes.v[7].x() = std::nextafter(s.nodes.v[7].x(), 1.0);
  EXPECT_NE(state_hash(s), before);
}

}  // namespace
}  // namespace knap
