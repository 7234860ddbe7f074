#include <gtest/gtest.h>

#include "core/parallel.hpp"
#include "simulation/persistent_arrays.hpp"
#include "simulation/step.hpp"
#include "tests/support/loose_pieces.hpp"
#include "time/rigid_motion.hpp"

namespace knap {
namespace {

constexpr double edge = 1e-4;

// Pieces at random places of a grid, with room to tumble, in a box of six walls.
Simulation tumbling_box(Index per_side, double restitution, double friction) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const double pitch = 2.2 * edge;
  TetMesh mesh;
  for (Index i = 0; i < per_side; ++i)
    for (Index j = 0; j < per_side; ++j)
      for (Index k = 0; k < per_side; ++k)
        add_cube(mesh, 1, (0.7 + 0.3 * std::abs(std::sin(i + 2.0 * j + 3.0 * k))) * edge,
                 pitch * Vec3(i + 0.5, j + 0.5, k + 0.5),
                 Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized());
  SimulationOptions options = loose_options(true, friction);
  options.restitution = restitution;
  for (int axis = 0; axis < 3; ++axis) {
    options.tools.push_back(wall(friction, Vec3::Zero(), Vec3::Unit(axis)));
    options.tools.push_back(wall(friction, per_side * pitch * Vec3::Ones(), -Vec3::Unit(axis)));
  }
  Simulation s = make_simulation(options, mesh);
  // Each piece flies and spins; from the first step on all are rigid.
  const Index pieces = per_side * per_side * per_side;
  for (Index piece = 0; piece < pieces; ++piece) {
    const Vec3 v = 20.0 * Vec3(normal(random), normal(random), normal(random));
    const Vec3 w = 20.0 / edge * Vec3(normal(random), normal(random), normal(random));
    const Vec3 centre = 0.5 * (xyz(s.nodes.x[at(8 * piece)]) + xyz(s.nodes.x[at(8 * piece + 7)]));
    for (Index n = 8 * piece; n < 8 * piece + 8; ++n)
      s.nodes.v[at(n)] = padded(v + w.cross(xyz(s.nodes.x[at(n)]) - centre));
  }
  s.nodes.v_before = s.nodes.v;
  balance_from_here(s);
  return s;
}

double kinetic(const Simulation& s) {
  double sum = 0.0;
  for (const RigidBody& body : s.rigid.bodies) sum += kinetic_energy(body);
  return sum;
}

// What the walls have given is accounted for.
Momentum momentum_without_walls(const Simulation& s) {
  Momentum all = momentum(s.nodes);
  for (const Tool& tool : s.tools) {
    all.linear -= tool.state.impulse;
    all.angular -= tool.state.angular_impulse;
  }
  return all;
}

TEST(TumblingBox, KeepsEnergyAndMomentaOverAHundredThousandSteps) {
  Simulation s = tumbling_box(6, 1.0, 0.0);
  const double energy = s.reference.incident_energy;
  const double momentum_scale = std::sqrt(2.0 * s.reference.start.mass * energy);
  const double size = s.tools[1].state.position.x();
  for (int i = 0; i < 100000; ++i) ASSERT_EQ(step(s), StepStatus::Ok) << "step " << i;
  ASSERT_EQ(s.rigid.num_bodies(), 216);
  EXPECT_NEAR(kinetic(s), energy, 1e-3 * energy);
  const Momentum end = momentum_without_walls(s);
  EXPECT_LT((end.linear - s.reference.start.linear).norm(), 1e-9 * momentum_scale);
  EXPECT_LT((end.angular - s.reference.start.angular).norm(), 1e-3 * momentum_scale * size);
  for (const RigidBody& body : s.rigid.bodies)
    EXPECT_TRUE((body.centre.array() > 0.0).all() && (body.centre.array() < size).all());
  EXPECT_LT(s.ledger.max_closure_error, 1e-3);
  RecordProperty("relative_energy_change", std::to_string(kinetic(s) / energy - 1.0));
}

TEST(TumblingBox, FrictionAndLossyImpactsOnlyDissipateAndTheLedgerCloses) {
  Simulation s = tumbling_box(4, 0.5, 0.3);
  double energy = s.reference.incident_energy;
  for (int i = 0; i < 20000; ++i) {
    ASSERT_EQ(step(s), StepStatus::Ok);
    if (i % 100 != 99) continue;
    EXPECT_LE(kinetic(s), energy * (1.0 + 1e-9));
    energy = kinetic(s);
  }
  EXPECT_LT(energy, 0.8 * s.reference.incident_energy);
  EXPECT_LT(s.ledger.max_closure_error, 1e-3);
}

TEST(TumblingBox, HasTheSameBitsForAnyNumberOfThreadsAndAcrossAResume) {
  const auto hash_after = [](int threads, int resume_at) {
    set_num_threads(threads);
    Simulation s = tumbling_box(3, 0.8, 0.2);
    for (int i = 0; i < 1500; ++i) {
      if (i == resume_at) {
        Simulation again = tumbling_box(3, 0.8, 0.2);
        restore_checkpoint(again, make_checkpoint(s));
        s = std::move(again);
      }
      step(s);
    }
    set_num_threads(0);
    return state_hash(s);
  };
  const std::string one = hash_after(1, -1);
  EXPECT_EQ(hash_after(2, -1), one);
  EXPECT_EQ(hash_after(3, -1), one);
  EXPECT_EQ(hash_after(1, 700), one);
}

// Three cubes on each other on a floor, in touch from the start, their faces not aligned.
Simulation stack() {
  TetMesh mesh;
  for (int i = 0; i < 3; ++i)
    add_cube(mesh, 1, edge, edge * Vec3(0.1 * i, -0.07 * i, i + 0.5),
             Eigen::Quaterniond(Eigen::AngleAxisd(0.3 * i, Vec3::UnitZ())));
  SimulationOptions options = loose_options(true, 0.4);
  options.tools = {wall(0.4)};
  options.gravity = {0.0, 0.0, -9.81};
  return make_simulation(options, mesh);
}

TEST(RigidContact, AStackAtRestStaysAtRest) {
  Simulation s = stack();
  const auto start = s.nodes.x;
  for (int i = 0; i < 20000; ++i) ASSERT_EQ(step(s), StepStatus::Ok);
  ASSERT_EQ(s.rigid.num_bodies(), 3);
  const double fall = 0.5 * 9.81 * s.clock.time() * s.clock.time();  // of what nothing holds
  double moved = 0.0;
  for (Index i = 0; i < s.nodes.size(); ++i) moved = std::max(moved, (s.nodes.x[at(i)] - start[at(i)]).norm());
  EXPECT_LT(moved, 1e-3 * fall);
  EXPECT_LT(kinetic(s), 1e-9 * s.reference.start.mass * 9.81 * edge);
}

// A block of eight cubes that only lie in each other's places, deformable, thrown onto a floor again and again.
TEST(LooseBlock, GainsNoEnergyWhileItBounces) {
  TetMesh mesh;
  for (int i = 0; i < 8; ++i)
    add_cube(mesh, 1, edge, edge * Vec3(0.5 + (i & 1), 0.5 + (i >> 1 & 1), 0.501 + (i >> 2 & 1)));
  SimulationOptions options = loose_options(false, 0.3);
  options.tools = {wall(0.3)};
  // So strong that it comes down every few hundred steps.
  options.gravity = {0.0, 0.0, -1e6};
  options.particles[0].velocity = {1.0, 0.0, -5.0};
  options.particles[0].spin = {0.0, 1e4, 0.0};
  Simulation s = make_simulation(options, mesh);
  const double start = s.ledger.total() - s.ledger[EnergyTerm::Gravity];
  ASSERT_EQ(s.contact.fragments, 8);
  const auto mechanical = [&s] {
    return s.ledger[EnergyTerm::Kinetic] + s.ledger[EnergyTerm::Strain] + s.ledger[EnergyTerm::Gravity];
  };
  double first = 0.0, largest = -1e300, last = 0.0;
  for (int i = 0; i < 100000; ++i) {
    ASSERT_EQ(step(s), StepStatus::Ok) << "step " << i;
    if (s.clock.step % s.options.ledger_interval != 1) continue;
    if (i < s.options.ledger_interval) first = mechanical();
    last = mechanical();
    largest = std::max(largest, last);
  }
  EXPECT_LE(largest, first + 1e-3 * std::abs(start));
  EXPECT_LT(last, first);
  EXPECT_LT(s.ledger.max_closure_error, 1e-2);
}

}  // namespace
}  // namespace knap
