// Several particles in one run.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cohesive/crack_faces.hpp"
#include "cohesive/fragments.hpp"
#include "core/errors.hpp"
#include "core/parallel.hpp"
#include "simulation/persistent_arrays.hpp"
#include "simulation/run.hpp"
#include "simulation/step.hpp"
#include "tests/support/bar_mesh.hpp"
#include "tests/support/granule.hpp"

namespace knap {
namespace {

void move(TetMesh& mesh, const Mat3& rotation, const Vec3& shift) {
  for (Vec3& x : mesh.vertices) x = rotation * x + shift;
}

// Momentum of the nodes of one particle.
Vec3 momentum_of(const Simulation& s, Index particle) {
  Vec3 sum = Vec3::Zero();
  for (Index t = 0; t < s.topology.num_tets(); ++t)
    if (s.reference.particle_of_tet[at(t)] == particle)
      for (const Index node : s.topology.tet_nodes[at(t)])
        sum += s.reference.corner_mass[at(t)] * xyz(s.nodes.v[at(node)]);
  return sum;
}

/// What Hertz's law predicts of two spheres or of one and a wall.
struct Impact {
  double time = 0.0;   ///< in which 1 to 99 % of the momentum change [s]
  double force = 0.0;  ///< largest [N]
  double restitution = 0.0;
};

// From the momentum of the upper particle over time: its slope is the force, over a window that is short against the
// contact and long against vibrations of the mesh.
Impact measured(const std::vector<double>& momentum, double dt, std::size_t window) {
  Impact impact;
  const double change = momentum.back() - momentum.front();
  std::size_t first = momentum.size(), last = 0;
  for (std::size_t i = 0; i + window < momentum.size(); ++i) {
    const double force = (momentum[i + window] - momentum[i]) / (static_cast<double>(window) * dt);
    impact.force = std::max(impact.force, force);
    if (momentum[i] - momentum.front() < 0.01 * change) first = i;
    if (momentum[i] - momentum.front() < 0.99 * change) last = i;
  }
  impact.time = static_cast<double>(last - first) * dt;
  impact.restitution = momentum.back() / -momentum.front();
  return impact;
}

Impact run_impact(Simulation& s, Index particle, double end_time, double window) {
  std::vector<double> momentum{momentum_of(s, particle).z()};
  while (s.clock.time() < end_time) {
    EXPECT_EQ(step(s), StepStatus::Ok);
    momentum.push_back(momentum_of(s, particle).z());
  }
  return measured(momentum, s.clock.dt, static_cast<std::size_t>(window / s.clock.dt));
}

// Spheres of the granule: above z = 0, and with a second one below it, turned so that no facets match.
Granule sphere(double speed) {
  Granule granule{.diameter = 2e-3, .element_size = 0.25e-3, .contact_element_size = 0.06e-3, .contact_extent = 0.3e-3};
  granule.particle.friction = 0.0;
  granule.particle.velocity = {0.0, 0.0, -speed};
  granule.options.step_safety = 0.8;
  return granule;
}

Simulation two_spheres(const Granule& granule) {
  const TetMesh above = granule_mesh(granule);
  TetMesh below = above;
  const Mat3 half_turn = Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX()).toRotationMatrix();
  move(below, Mat3(Eigen::AngleAxisd(0.4, Vec3::UnitZ()).toRotationMatrix() * half_turn), Vec3::Zero());
  SimulationOptions options = granule.options;
  options.particles = {granule.particle, granule.particle};
  options.particles[1].velocity = -granule.particle.velocity;
  return make_simulation(options, std::vector{above, below});
}

// By symmetry each of two equal spheres meets a rigid frictionless wall at their common tangent plane.
TEST(Particles, TwoEqualSpheresAreOneOnAFrictionlessWall) {
  const double speed = 14.0;
  Granule granule = sphere(speed);
  Simulation two = two_spheres(granule);
  granule.options.tools = {wall()};
  Simulation one = make_granule(granule);
  const double end = 1.1e-5, window = 0.15e-6;
  const Impact expected = run_impact(one, 0, end, window), found = run_impact(two, 0, end, window);
  EXPECT_NEAR(found.force / expected.force, 1.0, 0.005);
  EXPECT_NEAR(found.time / expected.time, 1.0, 0.005);
  EXPECT_NEAR(found.restitution, expected.restitution, 0.003);
  EXPECT_LT(two.ledger.max_closure_error, 1e-4);
}

// Chung & Ooi 2011, benchmark 1: glass spheres of 20 mm at +-10 m/s. Largest force of their curve, and the time in
// which 1 to 99 % of its integral pass. The curve is Hertz's law; at this rho v^2/E* of 5.6e-6 the answer is 3.5 %
// above it and 2.7 % shorter, see hertz_test.cpp. The rest is the mesh, five elements to the contact radius.
TEST(Particles, ForceOfTwoGlassSpheresIsTheBenchmarks) {
  Granule granule{.diameter = 20e-3, .element_size = 1.4e-3, .contact_element_size = 0.24e-3, .contact_extent = 2.3e-3};
  granule.particle = {.young_modulus = 48e9, .poisson_ratio = 0.2, .density = 2800.0};
  granule.particle.friction = 0.0;
  granule.particle.velocity = {0.0, 0.0, -10.0};
  granule.options.step_safety = 0.8;
  Simulation s = two_spheres(granule);
  const Impact found = run_impact(s, 0, 46e-6, 1e-6);
  EXPECT_NEAR(found.force / 10.7039e3, 1.0, 0.05);
  EXPECT_NEAR(found.time / 33.041e-6, 1.0, 0.05);
}

// Two bars meet end to end. Behind the waves both ends move with Z1 v/(Z1 + Z2), at the stress that the impedance
// Z = rho c of the other bar makes of what is left (one-dimensional: no lateral strain of these materials).
TEST(Particles, BarsOfTwoMaterialsSharePressureByTheirImpedances) {
  const double speed = 2.0, cell = 1e-3;
  const Index cells = 60;
  const ParticleOptions light{.young_modulus = 1e9, .poisson_ratio = 0.0, .density = 1000.0, .friction = 0.0};
  const ParticleOptions heavy{.young_modulus = 4e9, .poisson_ratio = 0.0, .density = 4000.0, .friction = 0.0};
  TetMesh first = bar_mesh({cells, 3, 3}, cell), second = bar_mesh({cells, 2, 2}, cell * 1.5);
  move(first, Mat3::Identity(), {-(60.0 * cell + 1e-9), 0.0, 0.0});
  SimulationOptions options{.particles = {light, heavy}};
  options.particles[0].velocity = {speed, 0.0, 0.0};
  Simulation s = make_simulation(options, std::vector{first, second});
  const double c = 1000.0, z_light = 1e6, z_heavy = 4e6;  // both materials have c = 1000 m/s
  while (s.clock.time() < 0.4 * 60.0 * cell / c) ASSERT_EQ(step(s), StepStatus::Ok);
  const double together = z_light * speed / (z_light + z_heavy), pressure = z_heavy * together;
  update_stress(s.elastic, s.nodes.x);
  std::array<double, 2> velocity{}, stress{}, count{};
  for (Index t = 0; t < s.topology.num_tets(); ++t) {
    const std::size_t p = at(s.reference.particle_of_tet[at(t)]);
    const double x = s.reference.vertices[at(s.topology.tet_vertices[at(t)][0])].x();
    if (std::abs(x) < 4.0 * cell || std::abs(x) > 15.0 * cell) continue;
    for (const Index node : s.topology.tet_nodes[at(t)]) velocity[p] += 0.25 * s.nodes.v[at(node)].x();
    stress[p] += s.elastic.stress[at(t)].xx;
    ++count[p];
  }
  for (const std::size_t p : {0u, 1u}) {
    EXPECT_NEAR(velocity[p] / count[p] / together, 1.0, 0.02) << p;
    EXPECT_NEAR(-stress[p] / count[p] / pressure, 1.0, 0.02) << p;
  }
  EXPECT_LT(s.ledger.max_closure_error, 0.01);
}

// Two granules of different materials and laws strike each other off their centres, one of them spinning.
Simulation breaking_pair(double viscous_ratio = 0.0) {
  Granule granule{.diameter = 1e-3, .element_size = 0.15e-3, .contact_element_size = 0.15e-3};
  granule.particle.fracture = zeolite_fracture();
  granule.particle.viscous_ratio = viscous_ratio;
  granule.particle.relaxation_time = 1e-6;
  granule.particle.velocity = {4.0, 0.0, -30.0};
  granule.particle.friction = 0.3;
  TetMesh above = granule_mesh(granule), below = above;
  for (Vec3& x : below.vertices) x = Vec3(x.x() + 0.2e-3, x.y(), -x.z());
  for (TetCorners& tet : below.tets) std::swap(tet[0], tet[1]);
  ParticleOptions other = granule.particle;
  other.young_modulus = 4e9;
  other.density = 2000.0;
  other.viscous_ratio = 0.0;
  other.fracture->strength = 12e6;
  other.fracture->law = {.beta = 2.0, .internal_friction = 0.4, .sliding_friction = 0.4};
  other.velocity = {0.0, 3.0, 20.0};
  other.spin = {1e4, 0.0, 5e3};
  return make_simulation({.particles = {granule.particle, other}}, std::vector{above, below});
}

void advance(Simulation& s, int steps) {
  for (int i = 0; i < steps; ++i) ASSERT_EQ(step(s), StepStatus::Ok);
}

TEST(Particles, BothBreakAndKeepMomentaAndEnergy) {
  Simulation s = breaking_pair();
  advance(s, 900);
  std::array<Index, 2> fragments{};
  const auto labels = fragment_labels(s.topology, s.cracks, FragmentLabel::Strict);
  std::vector<std::uint8_t> seen(at(num_fragments(labels)), 0);
  for (std::size_t t = 0; t < labels.size(); ++t)
    if (!std::exchange(seen[at(labels[t])], 1)) ++fragments[at(s.reference.particle_of_tet[t])];
  EXPECT_GT(fragments[0], 3);
  EXPECT_GT(fragments[1], 3);
  const Momentum now = momentum(s.nodes);
  const Momentum& start = s.reference.start;
  EXPECT_LT((now.linear - start.linear - s.totals.added_linear).norm() / momentum_of(s, 0).norm(), 1e-12);
  const Vec3 lost = now.angular - start.angular - s.totals.added_angular - pending_angular_momentum(s.cracks);
  EXPECT_LT(lost.norm() / start.angular.norm(), 5e-6);
  EXPECT_LT(s.ledger.max_closure_error, 2e-3);
}

TEST(Particles, SameBitsForAnyNumberOfThreads) {
  std::string expected;
  for (const int threads : {1, 2, 3}) {
    set_num_threads(threads);
    Simulation s = breaking_pair(0.3);
    advance(s, 400);
    EXPECT_GT(s.contact.fragments, 4);
    if (expected.empty()) expected = state_hash(s);
    EXPECT_EQ(state_hash(s), expected) << threads << " threads";
  }
  set_num_threads(0);
}

// Before the particles have met, while they break.
TEST(Particles, SameBitsAcrossACheckpoint) {
  Simulation whole = breaking_pair(0.3), first = breaking_pair(0.3);
  advance(whole, 420);
  for (const int steps : {10, 277}) {
    advance(first, steps);
    Simulation second = breaking_pair(0.3);
    restore_checkpoint(second, make_checkpoint(first));
    EXPECT_EQ(state_hash(second), state_hash(first));
    advance(second, 420 - static_cast<int>(first.clock.step));
    EXPECT_EQ(state_hash(second), state_hash(whole));
  }
}

std::vector<TetMesh> two_boxes(double gap) {
  std::vector<TetMesh> boxes{bar_mesh({2, 2, 2}, 1e-3), bar_mesh({3, 2, 2}, 1e-3)};
  move(boxes[1], Mat3::Identity(), {0.0, 0.0, 2e-3 + gap});
  return boxes;
}

SimulationOptions two_particles() {
  ParticleOptions soft{.young_modulus = 1e9, .poisson_ratio = 0.2, .density = 1000.0, .friction = 0.5};
  ParticleOptions stiff{.young_modulus = 9e9, .poisson_ratio = 0.2, .density = 1000.0, .friction = 0.2};
  soft.fracture = FractureOptions{.strength = 1e6, .fracture_energy = 3.0};
  return {.particles = {soft, stiff}};
}

TEST(Particles, EachHasItsOwnStrengthAndTheSmallestStepHolds) {
  const SimulationOptions options = two_particles();
  const auto meshes = two_boxes(1e-4);
  const Simulation both = make_simulation(options, meshes);
  for (Index f = 0; f < both.topology.num_facets(); ++f) {
    const Index particle = both.reference.particle_of_tet[at(both.topology.facet_tets[at(f)][0])];
    EXPECT_EQ(both.reference.facet_strength[at(f)], particle == 0 ? 1e6 : std::numeric_limits<double>::infinity());
  }
  std::array<double, 2> dt{};
  for (const std::size_t p : {0u, 1u}) {
    SimulationOptions alone = options;
    alone.particles = {options.particles[p]};
    dt[p] = make_simulation(alone, meshes[p]).clock.dt;
  }
  EXPECT_LT(dt[1], 0.5 * dt[0]);
  EXPECT_EQ(both.clock.dt, dt[1]);
  EXPECT_EQ(both.reference.pair_friction,
            (std::vector{CohesiveLaw{}.sliding_friction, 0.2, 0.2, CohesiveLaw{}.sliding_friction}));
}

// What the energy balance is measured against knows nothing of a velocity that all share.
TEST(Particles, IncidentEnergyIsThatAboutTheCommonMassCentre) {
  SimulationOptions options = two_particles();
  options.particles[0].velocity = {0.0, 0.0, 3.0};
  const double expected = make_simulation(options, two_boxes(1e-4)).ledger.reference;
  const double m1 = 8e-6, m2 = 12e-6;  // [kg]
  EXPECT_NEAR(expected / (0.5 * m1 * m2 / (m1 + m2) * 9.0), 1.0, 1e-12);
  for (ParticleOptions& particle : options.particles) particle.velocity += Vec3(40.0, 0.0, -20.0);
  EXPECT_NEAR(make_simulation(options, two_boxes(1e-4)).ledger.reference / expected, 1.0, 1e-10);
}

TEST(Particles, ARunWaitsUntilTheyHaveMet) {
  SimulationOptions options = two_particles();
  options.particles[0].velocity = {0.0, 0.0, 10.0};
  Simulation s = make_simulation(options, two_boxes(2e-4));
  const std::atomic<bool> interrupt{false};
  const StopReason reason = run(s, {.end_time = 1e-3, .automatic = true, .quiet_time = 2e-6}, {}, interrupt);
  EXPECT_EQ(reason, StopReason::AtRest);
  EXPECT_GT(s.totals.last_contact_step, 0);
  EXPECT_LT(s.clock.time(), 1e-4);
}

TEST(Particles, NeedAMeshEach) {
  const auto meshes = two_boxes(1e-4);
  EXPECT_THROW(make_simulation(two_particles(), meshes[0]), InputError);
  EXPECT_THROW(make_simulation({}, meshes), InputError);
}

TEST(Particles, ThatOverlapAreRefused) {
  EXPECT_NO_THROW(make_simulation(two_particles(), two_boxes(0.0)));
  EXPECT_THROW(make_simulation(two_particles(), two_boxes(-1e-5)), InputError);
  auto inside = two_boxes(1e-4);
  for (Vec3& x : inside[0].vertices) x = 0.1 * x + Vec3(0.55e-3, 0.62e-3, 2.7e-3);
  EXPECT_THROW(make_simulation(two_particles(), inside), InputError);
}

}  // namespace
}  // namespace knap
