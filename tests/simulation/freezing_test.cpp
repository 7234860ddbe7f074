#include "simulation/freezing.hpp"

#include <gtest/gtest.h>

#include "cohesive/crack_faces.hpp"
#include "core/parallel.hpp"
#include "simulation/persistent_arrays.hpp"
#include "simulation/step.hpp"
#include "tests/support/bar_mesh.hpp"
#include "tests/support/granule.hpp"
#include "time/rigid_motion.hpp"

namespace knap {
namespace {

constexpr double cell = 1e-4;
constexpr std::array<Index, 3> cells{8, 2, 2};

// A bar whose halves leave each other at twice 8 m/s, so that it breaks at its middle, and which turns and flies.
Simulation parting_bar(const SimulationOptions& options) {
  Simulation s = make_simulation(options, bar_mesh(cells, cell));
  const double middle = 0.5 * cells[0] * cell;
  for (Index i = 0; i < s.nodes.size(); ++i) {
    const double side = s.nodes.x[at(i)].x() - middle;
    s.nodes.v[at(i)].x() += std::abs(side) < 0.1 * cell ? 0.0 : std::copysign(8.0, side);
  }
  s.nodes.v_before = s.nodes.v;
  balance_from_here(s);
  return s;
}

SimulationOptions bar_options() {
  SimulationOptions options;
  options.particles = {{.young_modulus = 2.45e9, .poisson_ratio = 0.25, .density = 1270.0}};
  options.particles[0].fracture = zeolite_fracture();
  options.particles[0].fracture->fracture_energy = 0.5;
  options.particles[0].spin = {300.0, 2000.0, -4000.0};
  options.particles[0].velocity = {3.0, 1.0, 2.0};
  // All the vibration that the break has left in the halves.
  options.rigid_fragments = {.enabled = true, .strain_share = 2.0, .vibration_share = 2.0, .loss_share = 0.2};
  return options;
}

void step_until(Simulation& s, auto&& done, int most_steps = 6000) {
  for (int i = 0; i < most_steps && !done(); ++i) ASSERT_EQ(step(s), StepStatus::Ok);
  ASSERT_TRUE(done());
}

bool all_frozen(const Simulation& s) {
  return !s.rigid.body_of_tet.empty() && std::count(s.rigid.body_of_tet.begin(), s.rigid.body_of_tet.end(), none) == 0;
}

Simulation frozen_bar(const SimulationOptions& options) {
  Simulation s = parting_bar(options);
  step_until(s, [&s] { return all_frozen(s); });
  return s;
}

SimulationOptions viscous_bar_options(double viscous_ratio) {
  SimulationOptions options = bar_options();
  options.particles[0].viscous_ratio = viscous_ratio;
  options.particles[0].relaxation_time = 1e-6;
  return options;
}

// Compared with the same run without freezing, in the step that freezes the first fragment.
TEST(Freezing, TheLedgerOfTheStepClosesAsWithoutIt) {
  for (const double viscous_ratio : {0.0, 0.3}) {
    SimulationOptions options = viscous_bar_options(viscous_ratio);
    Simulation s = parting_bar(options);
    options.rigid_fragments.enabled = false;
    Simulation free = parting_bar(options);
    for (int i = 0; i < 6000 && s.rigid.bodies.empty(); ++i) {
      ASSERT_EQ(step(s), StepStatus::Ok);
      ASSERT_EQ(step(free), StepStatus::Ok);
    }
    ASSERT_FALSE(s.rigid.bodies.empty());
    EXPECT_GT(s.freezing.vibration, 1e-8 * s.ledger.reference);
    EXPECT_NEAR(s.ledger.total(), free.ledger.total(), 1e-14 * s.ledger.reference);
  }
}

TEST(Freezing, HalvesThatFlyApartKeepTheirMomenta) {
  const Simulation s = frozen_bar(bar_options());
  EXPECT_GE(s.rigid.num_bodies(), 2);
  EXPECT_GT(s.freezing.vibration, 1e-4 * s.ledger.reference);
  EXPECT_GT(s.ledger[EnergyTerm::Strain], 1e-6 * s.ledger.reference);
  EXPECT_LT(s.ledger.max_closure_error, 1e-2);  // eight cells long
  const Momentum now = momentum(s.nodes);
  const Momentum& start = s.reference.start;
  EXPECT_LT((now.linear - start.linear).norm(), 1e-12 * start.linear.norm());
  // The faces' twins give back what they have taken at the latest when they end.
  EXPECT_LT((now.angular - start.angular).norm(), 1e-6 * start.angular.norm());
}

TEST(Freezing, BodiesThatMeetNothingConserveEverything) {
  for (const double viscous_ratio : {0.0, 0.3}) {
    Simulation s = frozen_bar(viscous_bar_options(viscous_ratio));
    const double vibration = s.freezing.vibration, error = s.ledger.closure_error();
    const Momentum before = momentum(s.nodes);
    for (int i = 0; i < 960; ++i) ASSERT_EQ(step(s), StepStatus::Ok);
    const Momentum now = momentum(s.nodes);
    EXPECT_EQ(s.freezing.vibration, vibration);
    EXPECT_NEAR(s.ledger.closure_error(), error, 1e-12);
    EXPECT_LT((now.linear - before.linear).norm(), 1e-13 * before.linear.norm());
    EXPECT_LT((now.angular - before.angular).norm(), 1e-13 * before.angular.norm());
    EXPECT_LT((now.centre() - before.centre() - 960 * s.clock.dt * before.velocity()).norm(), 1e-12 * cell);
  }
}

TEST(Freezing, BodiesFallAndTheirPotentialIsBooked) {
  SimulationOptions options = bar_options();
  options.gravity = {2e6, 0.0, -5e6};  // a fall worth seeing in microseconds
  Simulation s = frozen_bar(options);
  const double total = s.ledger.total(), potential = s.ledger[EnergyTerm::Gravity];
  const Momentum before = momentum(s.nodes);
  for (int i = 0; i < 480; ++i) ASSERT_EQ(step(s), StepStatus::Ok);  // the last of them makes the balance
  EXPECT_LT(s.ledger[EnergyTerm::Gravity], potential - 0.01 * s.ledger.reference);
  EXPECT_NEAR(s.ledger.total(), total, 1e-12 * s.ledger.reference);
  const Vec3 gained = momentum(s.nodes).linear - before.linear;
  EXPECT_LT((gained - 480 * s.clock.dt * before.mass * options.gravity).norm(), 1e-12 * gained.norm());
}

// Every pair of nodes of a body keeps its distance.
TEST(Freezing, ABodyKeepsItsShape) {
  Simulation s = frozen_bar(bar_options());
  const auto nodes = s.rigid.nodes_of_body[0];
  const auto length = [&s](Index a, Index b) { return (s.nodes.x[at(a)] - s.nodes.x[at(b)]).norm(); };
  const double before = length(nodes.front(), nodes.back());
  for (int i = 0; i < 500; ++i) ASSERT_EQ(step(s), StepStatus::Ok);
  EXPECT_NEAR(length(nodes.front(), nodes.back()), before, 1e-12 * before);
}

Index largest_body(const Simulation& s) {
  Index largest = 0;
  for (Index b = 0; b < s.rigid.num_bodies(); ++b)
    if (s.rigid.bodies[at(b)].mass > s.rigid.bodies[at(largest)].mass) largest = b;
  return largest;
}

// Waking alone changes no energy and no momentum: the strain that was frozen is there again.
TEST(Freezing, WakingGivesBackWhatWasStored) {
  Simulation s = frozen_bar(bar_options());
  const double error = s.ledger.closure_error(), strain = s.ledger[EnergyTerm::Strain];
  const Momentum before = momentum(s.nodes);
  const Index breakable = static_cast<Index>(
      std::count_if(s.rigid.bodies.begin(), s.rigid.bodies.end(), [](const RigidBody& b) { return b.can_break(); }));
  const Index bodies = s.rigid.num_bodies();
  ASSERT_GE(breakable, 2);
  s.options.rigid_fragments.quiet_steps = 1000000;
  while (s.clock.step % s.options.ledger_interval != 0) ASSERT_EQ(step(s), StepStatus::Ok);
  for (RigidBody& body : s.rigid.bodies) body.load = 1e6;  // more than anything bears
  ASSERT_EQ(step(s), StepStatus::Ok);
  EXPECT_EQ(s.rigid.num_bodies(), bodies - breakable);
  EXPECT_NEAR(s.ledger[EnergyTerm::Strain], strain, 0.2 * strain);  // half a step turns some of it into motion
  EXPECT_NEAR(s.ledger.closure_error(), error, 1e-9);
  const Momentum now = momentum(s.nodes);
  EXPECT_LT((now.linear - before.linear).norm(), 1e-13 * before.linear.norm());
  const Vec3 pending = pending_angular_momentum(s.cracks);
  EXPECT_LT((now.angular - before.angular - pending).norm(), 1e-12 * before.angular.norm());
}

// A wall in the way of one half at several times the speed that breaks it.
TEST(Freezing, ABodyThatHitsAWallWakesAndBreaks) {
  SimulationOptions options = bar_options();
  options.particles[0].velocity = {60.0, 0.0, 0.0};
  options.tools.push_back(wall(0.0, {2.5e-3, 0.0, 0.0}, -Vec3::UnitX()));
  Simulation s = frozen_bar(options);
  const std::int64_t inserted = s.totals.inserted_facets;
  const Index bodies = s.rigid.num_bodies();
  ASSERT_EQ(s.tools[0].state.first_step, -1);
  step_until(s, [&s] { return s.tools[0].state.first_step >= 0; });
  EXPECT_LT(s.rigid.num_bodies(), bodies);
  step_until(
      s, [&] { return s.totals.inserted_facets > inserted; }, 400);
  EXPECT_LT(s.ledger.max_closure_error, 1e-3);
}

// The halves turned back onto each other, slower and faster than what could break them.
TEST(Freezing, OnlyAFastCollisionWakes) {
  for (const double speed : {0.5, 12.0}) {
    SimulationOptions options = bar_options();
    options.particles[0].spin = Vec3::Zero();
    Simulation s = frozen_bar(options);
    const Index largest = largest_body(s);
    const double side = s.rigid.bodies[at(largest)].centre.x() - momentum(s.nodes).centre().x();
    for (RigidBody& body : s.rigid.bodies) {
      const bool same_side = (body.centre.x() - momentum(s.nodes).centre().x()) * side > 0.0;
      body.velocity = {(same_side ? -0.5 : 0.5) * std::copysign(speed, side), 0.0, 0.0};
      body.angular_momentum = Vec3::Zero();
    }
    place_nodes(s.rigid, s.nodes);
    balance_energies(s);
    s.ledger.initial = s.ledger.total();
    const Index breakable = static_cast<Index>(
        std::count_if(s.rigid.bodies.begin(), s.rigid.bodies.end(), [](const RigidBody& b) { return b.can_break(); }));
    bool woke = false;
    const double before = s.contact.dissipated;
    for (int i = 0; i < 40000 && !woke && s.contact.dissipated - before < 0.1 * kinetic_energy(s.nodes); ++i) {
      ASSERT_EQ(step(s), StepStatus::Ok);
      woke = std::count_if(s.rigid.bodies.begin(), s.rigid.bodies.end(),
                           [](const RigidBody& b) { return b.can_break(); }) < breakable;
    }
    EXPECT_EQ(woke, speed > 5.0) << speed << " m/s";
    EXPECT_LT(s.ledger.closure_error(), 1e-4);
  }
}

// Fragments of a granule that breaks on a wall, some of them rigid from early on.
Simulation breaking_granule(double viscous_ratio) {
  Granule granule{.element_size = 0.2e-3, .contact_element_size = 0.15e-3};
  granule.particle.fracture = zeolite_fracture();
  granule.options.tools.push_back(wall(0.3));
  granule.particle.velocity = {10.0, 0.0, -28.0};
  granule.particle.viscous_ratio = viscous_ratio;
  granule.particle.relaxation_time = 2e-6;
  granule.options.rigid_fragments = {.enabled = true, .quiet_crossings = 1.0, .quiet_steps = 48};
  return make_granule(granule);
}

void advance(Simulation& s, int steps) {
  for (int i = 0; i < steps; ++i) ASSERT_EQ(step(s), StepStatus::Ok);
}

constexpr int granule_steps = 660;

TEST(Freezing, SameBitsForAnyNumberOfThreads) {
  std::string expected;
  for (const int threads : {1, 3}) {
    set_num_threads(threads);
    Simulation s = breaking_granule(0.0);
    advance(s, granule_steps);
    EXPECT_GT(s.rigid.num_bodies(), 10);
    if (expected.empty()) expected = state_hash(s);
    EXPECT_EQ(state_hash(s), expected) << threads << " threads";
  }
  set_num_threads(0);
}

TEST(Freezing, SameBitsAcrossACheckpoint) {
  for (const double viscous_ratio : {0.0, 0.3}) {
    Simulation whole = breaking_granule(viscous_ratio);
    advance(whole, granule_steps - 131);
    const Checkpoint checkpoint = make_checkpoint(whole);
    EXPECT_GT(whole.rigid.num_bodies(), 3);
    Simulation second = breaking_granule(viscous_ratio);
    restore_checkpoint(second, checkpoint);
    EXPECT_EQ(state_hash(second), state_hash(whole));
    advance(whole, 131);
    advance(second, 131);
    EXPECT_EQ(state_hash(second), state_hash(whole));
    EXPECT_LT(whole.ledger.max_closure_error, 1e-3);
  }
}

// Contacts are looked for every eighth step and kept in between: no step of these may forget anything.
TEST(Freezing, SameBitsFromWhicheverStep) {
  const auto granule = [] {
    Granule normal{.element_size = 0.2e-3, .contact_element_size = 0.2e-3};
    normal.particle.fracture = zeolite_fracture();
    normal.options.tools.push_back(wall(0.3));
    normal.particle.velocity = {0.0, 0.0, -35.0};
    normal.options.rigid_fragments.enabled = true;
    return make_granule(normal);
  };
  Simulation whole = granule();
  advance(whole, 700);
  for (int stop = 0; stop < 20; ++stop) {
    advance(whole, 33);
    Simulation second = granule();
    restore_checkpoint(second, make_checkpoint(whole));
    Simulation first = whole;
    advance(first, 10);
    advance(second, 10);
    EXPECT_EQ(state_hash(second), state_hash(first)) << "from step " << whole.clock.step;
  }
  EXPECT_GT(whole.rigid.num_bodies(), 10);
}

}  // namespace
}  // namespace knap
