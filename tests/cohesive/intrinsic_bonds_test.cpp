#include "cohesive/intrinsic_bonds.hpp"

#include <gtest/gtest.h>

#include <random>

#include "core/errors.hpp"
#include "simulation/make_simulation.hpp"
#include "simulation/step.hpp"
#include "tests/support/bar_mesh.hpp"

namespace knap {
namespace {

constexpr double modulus = 1e9, strength = 1e6, fracture_energy = 20.0, cell = 1e-3;

SimulationOptions bonded_options(double penalty_ratio = 10.0) {
  ParticleOptions particle{.young_modulus = modulus, .poisson_ratio = 0.0, .density = 1000.0};
  particle.fracture =
      FractureOptions{.strength = strength, .fracture_energy = fracture_energy, .penalty_ratio = penalty_ratio};
  return {.particles = {particle}};
}

BondScene scene(const Simulation& s) {
  return {s.topology, s.nodes.x, s.reference.facet_area, {s.reference.laws, s.reference.particle_of_tet}};
}

// Everything moved at random by at most so much.
void shake(Simulation& s, double amplitude) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> shift(-amplitude, amplitude);
  for (Vec4& x : s.nodes.x) x += padded(Vec3(shift(random), shift(random), shift(random)));
}

TEST(IntrinsicBonds, EveryCornerHasANodeOfItsOwn) {
  SimulationOptions options = bonded_options();
  options.particles[0].velocity = {3.0, -2.0, 1.0};
  options.particles[0].spin = {100.0, 50.0, -30.0};
  const TetMesh mesh = bar_mesh({3, 2, 2}, cell);
  const Simulation parted = make_simulation(options, mesh);
  options.particles[0].fracture->penalty_ratio = 0.0;
  const Simulation whole = make_simulation(options, mesh);
  EXPECT_EQ(parted.nodes.size(), 4 * mesh.num_tets());
  const Momentum a = momentum(parted.nodes), b = momentum(whole.nodes);
  EXPECT_NEAR(a.mass, b.mass, 1e-14 * b.mass);
  EXPECT_LT((a.linear - b.linear).norm(), 1e-13 * b.linear.norm());
  EXPECT_LT((a.angular - b.angular).norm(), 1e-13 * b.angular.norm());
  EXPECT_NEAR(kinetic_energy(parted.nodes), kinetic_energy(whole.nodes), 1e-13 * kinetic_energy(whole.nodes));
  EXPECT_EQ(parted.contact.fragments, 1);
}

TEST(IntrinsicBonds, ForcesAreTheGradientOfTheEnergy) {
  Simulation s = make_simulation(bonded_options(), bar_mesh({2, 1, 1}, cell));
  const double amplitude = 1e-6 * cell;  // a normal turns by as much: the force of that is left out
  shake(s, amplitude);
  std::vector<Vec4> f(s.nodes.x.size(), Vec4::Zero());
  add_bond_forces(s.reference.bonds, scene(s), f);
  double largest = 0.0;
  for (const Vec4& force : f) largest = std::max(largest, force.norm());
  const double h = 0.01 * amplitude;
  for (std::size_t i = 0; i < f.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const double here = s.nodes.x[i][k];
      s.nodes.x[i][k] = here + h;
      const double up = bond_energy(s.reference.bonds, scene(s));
      s.nodes.x[i][k] = here - h;
      const double down = bond_energy(s.reference.bonds, scene(s));
      s.nodes.x[i][k] = here;
      EXPECT_NEAR(-(up - down) / (2 * h), f[i][k], 1e-5 * largest);
    }
}

// The record takes over force and energy of the spring wherever the criterion is met in tension.
TEST(IntrinsicBonds, SofteningBeginsWhereTheSpringEnds) {
  const double stiffness = 1e13, area = 2e-7, dt = 1e-9;
  const CohesiveLaw law{.beta = 1.5, .kappa = 2.0};
  const double mode = law.beta * law.beta / law.kappa;
  for (const double angle : {0.0, 0.3, 0.8, 1.2}) {
    // On the way of this angle to where the effective opening is strength/stiffness.
    Vec3 jump(std::cos(angle), std::sin(angle), 0.0);
    jump *= strength / stiffness / std::sqrt(effective_opening2(law, jump.x(), jump.y() * jump.y()));
    CrackRecord record;
    record.strength = area * strength;
    record.delta_c = 2.0 * fracture_energy / strength;
    const double lost = soften_bond(record, law, {stiffness, area, jump, Vec3::UnitX(), dt});
    EXPECT_EQ(record.regime, RecordRegime::Softening);
    const double secant = secant_stiffness(record.strength, record.d_max, record.delta_c);
    EXPECT_NEAR(secant, stiffness * area, 1e-9 * stiffness * area);
    EXPECT_NEAR(lost, 0.0, 1e-9 * 0.5 * stiffness * area * jump.squaredNorm());
    EXPECT_LT(record.impulse.norm(), 1e-9 * dt * area * strength);
    // What is left to spend is G_c less the spring's own branch and what shear costs beyond: the line ends at delta_c.
    EXPECT_NEAR(0.5 * record.strength * (1.0 - record.d_max / record.delta_c) * record.delta_c, area * fracture_energy,
                1e-9 * area * fracture_energy);
  }
  // Pressed together, it slides: the pressure and the friction it allows go on as an impulse.
  const Vec3 pressed(-1e-7, 3e-7, 0.0);
  CrackRecord record;
  record.strength = area * (stiffness * mode * 3e-7 - law.internal_friction * stiffness * 1e-7) / law.beta;
  record.delta_c = 2.0 * fracture_energy * area / record.strength;
  const double lost = soften_bond(record, law, {stiffness, area, pressed, Vec3::UnitX(), dt});
  EXPECT_GT(lost, 0.0);
  EXPECT_NEAR(record.impulse.x(), dt * area * stiffness * 1e-7, 1e-9 * dt * area * stiffness * 1e-7);
  EXPECT_LT(record.impulse.y(), 0.0);
}

// A bar torn in two spends G_c on its section and nothing else.
TEST(IntrinsicBonds, TearingSpendsTheFractureEnergy) {
  SimulationOptions options = bonded_options();
  Simulation s = make_simulation(options, bar_mesh({8, 1, 1}, cell));
  // Weak in the middle alone.
  for (Index f = 0; f < s.topology.num_facets(); ++f)
    for (int k = 0; k < 3; ++k)
      if (std::abs(s.reference.vertices[at(s.topology.facet_vertex(f, k))].x() - 4.0 * cell) > 1e-9)
        s.reference.bonds.strength[at(f)] = 1e3 * strength;
  constexpr double rate = 2000.0;  // [1/s]
  for (std::size_t i = 0; i < s.nodes.x.size(); ++i) s.nodes.v[i][0] = rate * (s.nodes.x[i].x() - 4.0 * cell);
  s.nodes.v_before = s.nodes.v;
  balance_from_here(s);
  const double end = 60e-6;
  while (s.clock.time() < end) ASSERT_EQ(step(s), StepStatus::Ok);
  EXPECT_LT(s.ledger.max_closure_error, 1e-3);
  EXPECT_EQ(s.totals.inserted_facets, 2);
  for (const CrackRecord& record : s.cracks.records) ASSERT_EQ(record.regime, RecordRegime::Failed);
  EXPECT_NEAR(s.ledger[EnergyTerm::CohesiveDissipated], fracture_energy * cell * cell,
              0.01 * fracture_energy * cell * cell);
}

TEST(IntrinsicBonds, ASpringAsSoftAsTheCrackIsRefused) {
  SimulationOptions options = bonded_options(1.0);
  options.particles[0].fracture->fracture_energy = 0.1;
  EXPECT_THROW(make_simulation(options, bar_mesh({2, 1, 1}, cell)), InputError);
}

}  // namespace
}  // namespace knap
