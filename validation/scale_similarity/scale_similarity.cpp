// Dimensional analysis: a granule that is twice as large, four times as stiff and strong, and of sixteen times the
// density is the same granule in other units, if G_c/(sigma_c d), sigma_c/E and rho v^2/E are what they were. With
// powers of two the arithmetic itself scales, so the runs must agree to the bit; with a factor of three they agree
// until round-off has grown to a facet's decision.
#include <cmath>

#include "cohesive/fragments.hpp"
#include "tests/support/granule.hpp"
#include "validation/problems.hpp"
#include "validation/support/checked_step.hpp"

namespace knap {
namespace {

constexpr double diameter = 1.5e-3, speed = 22.0, end = 12e-6;

struct Scale {
  double length = 1.0, modulus = 1.0, density = 1.0;
  double speed() const { return std::sqrt(modulus / density); }
  double time() const { return length / speed(); }
};

Simulation granule(const TetMesh& mesh, const Scale& scale) {
  ParticleOptions particle{
      .young_modulus = scale.modulus * 2.45e9, .poisson_ratio = 0.25, .density = scale.density * 1270.0};
  particle.velocity = {0.0, 0.0, -scale.speed() * speed};
  particle.fracture = zeolite_fracture();
  particle.fracture->strength *= scale.modulus;
  particle.fracture->fracture_energy *= scale.modulus * scale.length;
  SimulationOptions options{.particles = {particle}};
  options.tools = {wall(0.3)};
  TetMesh scaled = mesh;
  for (Vec3& x : scaled.vertices) x *= scale.length;
  return make_simulation(options, scaled);
}

struct Outcome {
  std::vector<FacetState> facets;
  std::vector<Index> fragments;
  PlotSeries pieces;     // over time in units of the unscaled granule
  double kinetic = 0.0;  // over the incident energy [-]
};

Outcome outcome(const TetMesh& mesh, const Scale& scale, const std::string& name) {
  Simulation s = granule(mesh, scale);
  Outcome result{.facets = {}, .fragments = {}, .pieces = {.name = name}};
  while (s.clock.time() < end * scale.time()) {
    checked_step(s);
    if (s.clock.step % 50 != 0) continue;
    const auto labels = fragment_labels(s.topology, s.cracks, FragmentLabel::Damage);
    result.pieces.x.push_back(1e6 * s.clock.time() / scale.time());
    result.pieces.y.push_back(num_fragments(labels));
  }
  balance_energies(s);
  result.facets = s.topology.facet_state;
  result.fragments = fragment_labels(s.topology, s.cracks, FragmentLabel::Damage);
  result.kinetic = s.ledger[EnergyTerm::Kinetic] / s.ledger.reference;
  return result;
}

// Facets whose states differ, over those that are cracked.
double different(const Outcome& a, const Outcome& b) {
  double differ = 0.0, cracked = 0.0;
  for (std::size_t f = 0; f < a.facets.size(); ++f) {
    differ += a.facets[f] != b.facets[f];
    cracked += a.facets[f] != FacetState::Bonded;
  }
  return differ / cracked;
}

}  // namespace

void show_scale_similarity(Evidence& evidence) {
  const double size = evidence.is_short() ? 0.2e-3 : 0.12e-3;
  const TetMesh mesh = granule_mesh({.diameter = diameter, .element_size = size, .contact_element_size = size});
  const Outcome one = outcome(mesh, {}, "as it is");
  const Outcome two = outcome(mesh, {2.0, 4.0, 16.0}, "length x 2, modulus x 4, density x 16");
  const Outcome three = outcome(mesh, {3.0, 3.0, 1.0}, "length x 3, modulus x 3");
  evidence.at_most("facets in another state, scaled by powers of two [-]", different(one, two), 0.0,
                   "the arithmetic scales exactly");
  evidence.at_most("tets in another fragment, scaled by powers of two", one.fragments == two.fragments ? 0.0 : 1.0, 0.0,
                   "likewise");
  evidence.absolute("final kinetic energy, scaled by three [-]", three.kinetic, one.kinetic, 0.03,
                    "round-off grows to other cracks, no further");
  evidence.tell("facets in another state, scaled by three [-]", different(one, three),
                "chaotic after the first cracks");
  evidence.curve({{"time over scale [us]", one.pieces.x}, {"fragments", one.pieces.y}});
  evidence.plot(
      {.title = "The same granule in other units",
       .x_label = "time over the scale of time [us]",
       .y_label = "fragments by damage",
       .series = {one.pieces, {two.pieces.name, two.pieces.x, two.pieces.y, PlotSeries::Style::Dashes}, three.pieces}});
}

}  // namespace knap
