// The exact one-interface problem: two half-bars under uniform stress sigma0 above the strength part at
//   opening = delta_c (sigma0/sigma_c - 1)(exp(t/tau) - 1),   tau = rho c G_c/sigma_c^2
// until they are free (physics.md section 3): each side radiates waves of impedance rho c.
#include <gtest/gtest.h>

#include "cohesive/insertion.hpp"
#include "fem/elastic_force.hpp"
#include "simulation/make_simulation.hpp"
#include "simulation/step.hpp"
#include "tests/support/bar_mesh.hpp"

namespace knap {
namespace {

constexpr double modulus = 1e9, density = 1000.0, strength = 1e6, fracture_energy = 2.0;

struct Interface {
  Simulation s;
  double tau;
  double delta_c;
};

// A bar of `cells` x 1 x 1 cells under stress `overload` x strength, cracked at its middle.
Interface parted_bar(Index cells, double length, double overload, const Vec3& direction) {
  ParticleOptions particle{.young_modulus = modulus, .poisson_ratio = 0.0, .density = density};
  particle.fracture = FractureOptions{.strength = 1e3 * strength, .fracture_energy = fracture_energy};
  // Only what is opened here.
  const SimulationOptions options{.particles = {particle}, .insertion_interval = 1 << 30};
  Interface bar{make_simulation(options, bar_mesh({cells, 1, 1}, length / cells)), 0.0, 0.0};
  Simulation& s = bar.s;
  s.clock.step = 1;
  const double wave_speed = std::sqrt((direction.x() > 0.5 ? modulus : 0.5 * modulus) / density);
  bar.tau = density * wave_speed * fracture_energy / (strength * strength);
  bar.delta_c = 2.0 * fracture_energy / strength;
  const double strain = overload * strength / (direction.x() > 0.5 ? modulus : 0.5 * modulus);
  for (Index i = 0; i < s.nodes.size(); ++i) xyz(s.nodes.x[at(i)]) += strain * s.nodes.x[at(i)].x() * direction;
  update_elastic_forces(s.elastic, s.nodes.x, s.nodes.f, 0.0);
  update_stress(s.elastic, s.nodes.x);
  std::vector<OverloadedFacet> facets;
  for (Index f = 0; f < s.topology.num_facets(); ++f) {
    bool in_plane = true;
    for (int k = 0; k < 3; ++k)
      in_plane =
          in_plane && std::abs(s.reference.vertices[at(s.topology.facet_vertex(f, k))].x() - 0.5 * length) < 1e-9;
    if (in_plane) facets.push_back({f, strength, Vec3::Zero()});
  }
  const auto change = insert_cracks(s.cracks, s.topology, s.nodes, facets,
                                    {.dt = s.clock.dt,
                                     .fracture_energy = s.reference.fracture_energy,
                                     .facet_area = s.reference.facet_area,
                                     .corner_mass = s.reference.corner_mass,
                                     .stress = s.elastic.stress});
  refresh_elastic_force(s.elastic, s.topology, change.changed_tets);
  update_elastic_forces(s.elastic, s.nodes.x, s.nodes.f, 0.0);
  balance_from_here(s);
  return bar;
}

double opening(const Simulation& s, const Vec3& direction) {
  double sum = 0.0;
  for (const CrackRecord& record : s.cracks.records)
    sum += std::abs((s.nodes.x[at(record.node_b)] - s.nodes.x[at(record.node_a)]).head<3>().dot(direction));
  return sum / static_cast<double>(s.cracks.records.size());
}

// Largest deviation from the exact opening, relative to delta_c, until the sides are free.
double largest_deviation(double overload) {
  // Failure at tau ln(1 + 1/(overload - 1)); the bar is long enough that the release waves of its ends come later.
  const double l_ch = modulus * fracture_energy / (strength * strength);
  const Vec3 x = Vec3::UnitX();
  Interface bar = parted_bar(240, 6.0 * l_ch, overload, x);
  const double failure = bar.tau * std::log(1.0 + 1.0 / (overload - 1.0));
  EXPECT_LT(failure, 2.5 * l_ch / std::sqrt(modulus / density));
  double largest = 0.0;
  const double start = bar.s.clock.time();
  while (bar.s.clock.time() - start < failure) {
    EXPECT_EQ(step(bar.s), StepStatus::Ok);
    const double t = bar.s.clock.time() - start;
    const double exact = bar.delta_c * (overload - 1.0) * std::expm1(t / bar.tau);
    largest = std::max(largest, std::abs(opening(bar.s, x) - exact) / bar.delta_c);
  }
  return largest;
}

TEST(Interface, OpensAsTheExactSolutionWithinTwoPercent) {
  for (const double overload : {1.1, 1.3, 2.0}) EXPECT_LT(largest_deviation(overload), 0.02) << overload;
}

// All that the crack dissipates is G_c times its area, once it is open.
TEST(Interface, DissipatesTheFractureEnergy) {
  const double l_ch = modulus * fracture_energy / (strength * strength);
  Interface bar = parted_bar(120, 6.0 * l_ch, 1.3, Vec3::UnitX());
  Simulation& s = bar.s;
  const double end = s.clock.time() + 2.0 * bar.tau;
  while (s.clock.time() < end) ASSERT_EQ(step(s), StepStatus::Ok);
  for (const CrackRecord& record : s.cracks.records) ASSERT_EQ(record.regime, RecordRegime::Failed);
  const CrackEnergies energies =
      crack_energies(s.cracks, s.nodes, {s.reference.laws, s.clock.dt, s.options.impulse_sweeps});
  double area = 0.0;
  for (const CrackFace& face : s.cracks.faces) area += face.area;
  EXPECT_NEAR(energies.losses.cohesive / (fracture_energy * area), 1.0, 0.005);  // the step's share of the opening
}

}  // namespace
}  // namespace knap
