// When a run stops by itself.
#include "simulation/run.hpp"

#include <gtest/gtest.h>

#include <map>

#include "simulation/persistent_arrays.hpp"
#include "tests/support/granule.hpp"

namespace knap {
namespace {

constexpr double crossing_time = 1.5e-3 / 1521.0;  // of the P wave through the zeolite sphere [s]
constexpr double quiet_time = 10.0 * crossing_time;

// Cracks at the contact, rebounds in one piece and vibrates.
Simulation cracked_granule() {
  Granule granule{.element_size = 0.2e-3, .contact_element_size = 0.15e-3};
  granule.options.fracture = zeolite_fracture();
  granule.options.tools = {wall(0.3)};
  granule.options.velocity = {0.0, 0.0, -12.0};
  return make_granule(granule);
}

StopReason run_until(Simulation& s, double end_time, std::span<Observer* const> observers = {}) {
  const std::atomic<bool> interrupt{false};
  return run(s, {.end_time = end_time, .automatic = true, .quiet_time = quiet_time}, observers, interrupt);
}

/// Work of separation over time, from the balances.
class DamageHistory : public Observer {
 public:
  DamageHistory() : Observer(24) {}
  void look(const Simulation& s) override { spent[s.clock.time()] = s.ledger[EnergyTerm::CohesiveDissipated]; }
  double at_time(double time) const { return std::prev(spent.upper_bound(time))->second; }

  std::map<double, double> spent;
};

TEST(AutomaticStop, ComesTenCrossingsAfterTheLastDamageThoughThePieceVibrates) {
  Simulation s = cracked_granule();
  DamageHistory history;
  Observer* const observers[] = {&history};
  EXPECT_EQ(run_until(s, 50.0 * crossing_time, observers), StopReason::AtRest);
  const double incident = s.reference.incident_energy, end = s.clock.time();
  const double contact_end = s.clock.dt * static_cast<double>(s.tools[0].state.last_step);
  EXPECT_GT(history.at_time(end), 1e-4 * incident);
  EXPECT_GT(end, contact_end + quiet_time);
  EXPECT_LT(end, contact_end + 2.0 * quiet_time);
  const double between_balances = 24.0 * s.clock.dt;
  for (double t = end - quiet_time + 2.0 * between_balances; t < end; t += 0.1 * crossing_time)
    EXPECT_NEAR(history.at_time(t), history.at_time(end), 2e-5 * incident) << t;
}

TEST(AutomaticStop, IsTheSameAcrossACheckpoint) {
  Simulation whole = cracked_granule();
  run_until(whole, 50.0 * crossing_time);
  Simulation first = cracked_granule();
  EXPECT_EQ(run_until(first, whole.clock.time() - 0.5 * quiet_time), StopReason::EndTime);
  Simulation second = cracked_granule();
  restore_checkpoint(second, make_checkpoint(first));
  EXPECT_EQ(run_until(second, 50.0 * crossing_time), StopReason::AtRest);
  EXPECT_EQ(second.clock.step, whole.clock.step);
  EXPECT_EQ(state_hash(second), state_hash(whole));
}

}  // namespace
}  // namespace knap
