#include "loading/prescribed_nodes.hpp"

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "core/parallel.hpp"
#include "simulation/make_simulation.hpp"
#include "simulation/persistent_arrays.hpp"
#include "simulation/step.hpp"
#include "tests/support/bar_mesh.hpp"

namespace knap {
namespace {

constexpr double modulus = 1e9, density = 1000.0, cell = 1e-3;
const double wave_speed = std::sqrt(modulus / density);

// Vertices of a bar with x at `x`.
std::vector<Index> section(const TetMesh& mesh, double x) {
  std::vector<Index> vertices;
  for (Index i = 0; i < mesh.num_vertices(); ++i)
    if (std::abs(mesh.vertices[at(i)].x() - x) < 1e-9) vertices.push_back(i);
  return vertices;
}

// A bar of `length` cells, its left end held, its right end led along x.
Simulation pulled_bar(Index length, double speed, double ramp_time, std::optional<FractureOptions> fracture = {}) {
  const TetMesh mesh = bar_mesh({length, 2, 2}, cell);
  SimulationOptions options;
  options.particles = {{.young_modulus = modulus, .poisson_ratio = 0.0, .density = density}};
  options.particles[0].fracture = fracture;
  options.prescribed = {{.vertices = section(mesh, 0.0)},
                        {.vertices = section(mesh, length * cell), .velocity = {speed, 0, 0}, .ramp_time = ramp_time}};
  return make_simulation(options, mesh);
}

TEST(PrescribedNodes, GoTheWayOfTheirRampWhateverPulls) {
  const double speed = 0.5, ramp_time = 5e-6;
  Simulation s = pulled_bar(10, speed, ramp_time);
  while (s.clock.time() < 3.0 * ramp_time) ASSERT_EQ(step(s), StepStatus::Ok);
  const double way = speed * (s.clock.time() - 0.5 * ramp_time);
  for (const PrescribedNodes& group : s.prescribed)
    for (const Index i : group.nodes) {
      const double expected = s.reference.vertices[at(i)].x() > 0.0 ? way : 0.0;
      EXPECT_NEAR((Vec3(xyz(s.nodes.x[at(i)])) - s.reference.vertices[at(i)] - expected * Vec3::UnitX()).norm(), 0.0,
                  1e-9 * way);
    }
}

TEST(PrescribedNodes, AnEndPulledAtOnceFeelsTheImpedanceOfTheBar) {
  const double speed = 0.1;
  Simulation s = pulled_bar(40, speed, 0.0);
  while (s.clock.time() < 30.0 * cell / wave_speed) ASSERT_EQ(step(s), StepStatus::Ok);
  const double area = 4.0 * cell * cell;
  const double expected = density * wave_speed * speed * area * s.clock.time();
  EXPECT_NEAR(s.prescribed[1].state.impulse.x() / expected, 1.0, 0.01);
  EXPECT_NEAR(s.prescribed[0].state.impulse.x() / expected, 0.0, 1e-6);  // the wave has not come yet
}

TEST(PrescribedNodes, DoTheWorkThatTheBodyGains) {
  Simulation s = pulled_bar(10, 0.5, 5e-6);
  while (s.clock.time() < 100e-6) ASSERT_EQ(step(s), StepStatus::Ok);
  const double work = s.prescribed[1].state.work;
  EXPECT_GT(work, 0.0);
  EXPECT_EQ(s.prescribed[0].state.work, 0.0);
  EXPECT_EQ(s.ledger[EnergyTerm::ToolWork] < 0.0, true);
  // Strain of 0.5 %: what leapfrog leaves of the law's nonlinearity.
  EXPECT_LT(s.ledger.max_closure_error, 1e-5);
  // A whole step: what the nodes have been given is what the body has.
  const Vec3 given = s.prescribed[0].state.impulse + s.prescribed[1].state.impulse;
  EXPECT_NEAR((momentum(s.nodes).linear - given).norm(), 0.0, 1e-12 * s.prescribed[1].state.impulse.norm());
}

TEST(PrescribedNodes, LeaveTheOtherAxesFree) {
  const TetMesh mesh = bar_mesh({2, 2, 2}, cell);
  SimulationOptions options;
  options.particles = {{.young_modulus = modulus, .poisson_ratio = 0.0, .density = density}};
  options.particles[0].velocity = {1.0, 2.0, 3.0};
  std::vector<Index> all(at(mesh.num_vertices()));
  for (Index i = 0; i < mesh.num_vertices(); ++i) all[at(i)] = i;
  options.prescribed = {{.vertices = all, .axes = {false, false, true}}};
  Simulation s = make_simulation(options, mesh);
  ASSERT_EQ(step(s), StepStatus::Ok);
  for (const Vec4& v : s.nodes.v) EXPECT_NEAR((Vec3(xyz(v)) - Vec3(1.0, 2.0, 0.0)).norm(), 0.0, 1e-9);
  const double mass = momentum(s.nodes).mass;
  EXPECT_NEAR(s.prescribed[0].state.work, -0.5 * mass * 9.0, 1e-9 * mass);
}

FractureOptions weak() {
  FractureOptions fracture;
  fracture.strength = 1e6;
  fracture.fracture_energy = 0.2;
  return fracture;
}

TEST(PrescribedNodes, TearABarApartAndLeadTheNodesThatSplitsAdd) {
  Simulation s = pulled_bar(10, 5.0, 1e-6, weak());
  while (s.clock.time() < 40e-6) ASSERT_EQ(step(s), StepStatus::Ok);
  ASSERT_GT(s.totals.inserted_facets, 0);
  ASSERT_GT(s.prescribed[1].nodes.size(), 9u);  // broken at the end that is led, among other places
  for (const Index i : s.prescribed[1].nodes) {
    EXPECT_EQ(s.reference.vertices[at(s.topology.vertex_of_node[at(i)])].x(), 10.0 * cell);
    EXPECT_EQ(s.nodes.v[at(i)].x(), s.prescribed[1].velocity.x());
  }
  EXPECT_LT(s.ledger.max_closure_error, 2e-3);
}

TEST(PrescribedNodes, HaveTheSameBitsForAnyNumberOfThreadsAndAcrossAResume) {
  std::vector<std::string> hashes;
  Checkpoint half;
  for (const int threads : {1, 3}) {
    set_num_threads(threads);
    Simulation s = pulled_bar(10, 5.0, 1e-6, weak());
    for (int n = 0; n < 301; ++n) {
      if (n == 200) half = make_checkpoint(s);
      ASSERT_EQ(step(s), StepStatus::Ok);
    }
    EXPECT_GT(s.totals.inserted_facets, 0);
    hashes.push_back(state_hash(s));
  }
  Simulation resumed = pulled_bar(10, 5.0, 1e-6, weak());
  restore_checkpoint(resumed, half);
  for (int n = 200; n < 301; ++n) ASSERT_EQ(step(resumed), StepStatus::Ok);
  hashes.push_back(state_hash(resumed));
  set_num_threads(0);
  EXPECT_EQ(hashes[1], hashes[0]);
  EXPECT_EQ(hashes[2], hashes[0]);
  Simulation other = pulled_bar(10, 4.0, 1e-6, weak());
  EXPECT_THROW(restore_checkpoint(other, half), InputError);
}

TEST(PrescribedNodes, RefuseVerticesThatThereAreNot) {
  SimulationOptions options;
  options.particles = {{.young_modulus = modulus, .poisson_ratio = 0.0, .density = density}};
  options.prescribed = {{.vertices = {27}}};
  EXPECT_THROW(make_simulation(options, bar_mesh({2, 2, 2}, cell)), InputError);
  options.prescribed = {{.vertices = {26}}};
  EXPECT_NO_THROW(make_simulation(options, bar_mesh({2, 2, 2}, cell)));
  options.rigid_fragments.enabled = true;
  EXPECT_THROW(make_simulation(options, bar_mesh({2, 2, 2}, cell)), InputError);
}

}  // namespace
}  // namespace knap
