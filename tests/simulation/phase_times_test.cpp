#include <gmock/gmock.h>

#include <cstring>
#include <memory>
#include <new>

#include "simulation/make_simulation.hpp"
#include "simulation/step.hpp"
#include "tests/support/bar_mesh.hpp"

namespace knap {
namespace {

TEST(PhaseTimes, StartAtZeroWhateverWasInMemory) {
  alignas(Simulation) std::array<std::byte, sizeof(Simulation)> memory;
  std::memset(memory.data(), 0xFF, memory.size());
  Simulation* s = new (memory.data()) Simulation;
  EXPECT_THAT(s->phase_times, testing::Each(0.0));
  std::destroy_at(s);
}

TEST(PhaseTimes, MotionTakesSome) {
  Simulation s = make_simulation({.particles = {{.young_modulus = 1e9, .poisson_ratio = 0.2, .density = 1000.0}}},
                                 bar_mesh({4, 4, 4}, 1e-3));
  for (int i = 0; i < 10; ++i) ASSERT_EQ(step(s), StepStatus::Ok);
  EXPECT_GT(s.phase_times[static_cast<std::size_t>(Phase::Motion)], 0.0);
  EXPECT_GT(s.phase_times[static_cast<std::size_t>(Phase::BulkForces)], 0.0);
}

}  // namespace
}  // namespace knap
