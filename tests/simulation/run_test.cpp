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
  granule.particle.fracture = zeolite_fracture();
  granule.options.tools = {wall(0.3)};
  granule.particle.velocity = {0.0, 0.0, -12.0};
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

// The force of an elastic impact rises and falls once. It counts as cracked, which is all that is asked for beside.
Simulation elastic_granule() {
  Granule granule{.element_size = 0.3e-3, .contact_element_size = 0.2e-3};
  granule.options.tools = {wall(0.0)};
  granule.particle.velocity = {0.0, 0.0, -5.0};
  Simulation s = make_granule(granule);
  s.totals.inserted_facets = 1;
  return s;
}

StopReason run_until_drop(Simulation& s, double end_time, double least) {
  const std::atomic<bool> interrupt{false};
  const ForceDrop drop{.tool = 0, .share = 0.4, .least = least, .window = 16};
  return run(s, {.end_time = end_time, .automatic = false, .force_drop = drop}, {}, interrupt);
}

TEST(ForceDrop, EndsTheRunWhereTheForceHasFallenToItsShare) {
  Simulation s = elastic_granule();
  ASSERT_EQ(run_until_drop(s, 20e-6, 0.0), StopReason::ForceDropped);
  const double largest = s.totals.force_watch.largest;
  EXPECT_GT(largest, 0.8 * s.tools[0].state.max_force);
  EXPECT_LE(largest, s.tools[0].state.max_force);
  Simulation before = elastic_granule();
  ASSERT_EQ(run_until_drop(before, s.clock.time() - 16.5 * s.clock.dt, 0.0), StopReason::EndTime);
  const double force = (s.tools[0].state.impulse - before.tools[0].state.impulse).norm() / (16.0 * s.clock.dt);
  EXPECT_LT(force, 0.4 * largest);
  EXPECT_GT(force, 0.2 * largest);  // the first window below
}

TEST(ForceDrop, ASmallForceDoesNotCount) {
  Simulation s = elastic_granule();
  EXPECT_EQ(run_until_drop(s, 20e-6, 1e6), StopReason::EndTime);
}

TEST(ForceDrop, NothingDropsBeforeACrack) {
  Simulation s = elastic_granule();
  s.totals.inserted_facets = 0;
  EXPECT_EQ(run_until_drop(s, 20e-6, 0.0), StopReason::EndTime);
}

TEST(ForceDrop, IsTheSameAcrossACheckpoint) {
  Simulation whole = elastic_granule();
  run_until_drop(whole, 20e-6, 0.0);
  Simulation first = elastic_granule();
  ASSERT_EQ(run_until_drop(first, 0.7 * whole.clock.time(), 0.0), StopReason::EndTime);
  Simulation second = elastic_granule();
  restore_checkpoint(second, make_checkpoint(first));
  EXPECT_EQ(run_until_drop(second, 20e-6, 0.0), StopReason::ForceDropped);
  EXPECT_EQ(second.clock.step, whole.clock.step);
  EXPECT_EQ(state_hash(second), state_hash(whole));
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
