#include "app/run_outcome.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "simulation/persistent_arrays.hpp"

namespace knap {
namespace {

Pieces pieces(const Simulation& s, FragmentLabel label) {
  const auto labels = fragment_labels(s.topology, s.cracks, label);
  std::vector<double> densities;
  for (const ParticleOptions& particle : s.options.particles) densities.push_back(particle.density);
  Pieces result;
  result.fragment_of_tet = labels_by_size(labels, s.reference.tet_volume);
  result.fragments = find_fragments({.tet_nodes = s.topology.tet_nodes,
                                     .tet_facets = s.topology.tet_facets,
                                     .facet_tets = s.topology.facet_tets,
                                     .x = s.nodes.x,
                                     .v = s.nodes.v,
                                     .tet_volume = s.reference.tet_volume,
                                     .densities = densities,
                                     .label = labels,
                                     .particle_of_tet = s.reference.particle_of_tet});
  return result;
}

// The term that grew or fell most between two ledgers.
EnergyTerm most_changed(const EnergyLedger& before, const EnergyLedger& now) {
  std::size_t worst = 0;
  double largest = -1.0;
  for (std::size_t term = 0; term < num_energy_terms; ++term) {
    const double change = std::abs(now.value[term] - before.value[term]);
    if (!std::isfinite(change)) return static_cast<EnergyTerm>(term);
    if (change > largest) worst = term, largest = change;
  }
  return static_cast<EnergyTerm>(worst);
}

// Of the particle's own fragments, over its own mass and size.
ParticleOutcome particle_outcome(const ParticleIdentity& particle, Index number, const Pieces& pieces,
                                 double element_size) {
  std::vector<Fragment> own;
  for (const Fragment& fragment : pieces.fragments)
    if (fragment.particle == number) own.push_back(fragment);
  ParticleOutcome outcome{.name = particle.name, .velocity = own.front().velocity};
  for (const Fragment& fragment : own) outcome.mass += fragment.mass;
  outcome.measures = breakage_measures(own, {outcome.mass, particle.diameter, element_size});
  return outcome;
}

}  // namespace

RunOutcome run_outcome(const Simulation& s, const RunIdentity& identity, const Session& session) {
  RunOutcome outcome{.case_name = identity.case_name,
                     .session = session,
                     .card = identity.card,
                     .quality = identity.quality,
                     .strict = pieces(s, FragmentLabel::Strict),
                     .damage = pieces(s, FragmentLabel::Damage),
                     .cracks = crack_census(s),
                     .rebound = rebound(s),
                     .momentum = momentum_errors(s, 0.5 * identity.card.input.diameter),
                     .state_hash = state_hash(s),
                     .onset = identity.onset};
  const ParticleScale scale{s.reference.start.mass, identity.card.input.diameter, s.reference.mean_edge};
  outcome.strict.measures = breakage_measures(outcome.strict.fragments, scale);
  outcome.damage.measures = breakage_measures(outcome.damage.fragments, scale);
  for (std::size_t i = 0; i < identity.particles.size(); ++i)
    outcome.particles.push_back(
        particle_outcome(identity.particles[i], to_index(i), outcome.damage, s.reference.mean_edge));
  return outcome;
}

std::string_view status(StopReason reason) {
  switch (reason) {
    case StopReason::AtRest:
    case StopReason::EndTime:
    case StopReason::ForceDropped:
      return "finished";
    case StopReason::Interrupted:
      return "interrupted";
    case StopReason::EnergyNotClosed:
    case StopReason::NotFinite:
      break;
  }
  return "failed";
}

std::string failure_message(const Simulation& s, StopReason reason) {
  const EnergyTerm term = most_changed(s.last_good_ledger, s.ledger);
  const double incident = s.ledger.reference;
  const std::string change = fmt::format(
      "since the balance was last within 1 %, {} changed most: from {:.4g} to {:.4g} of the incident energy",
      name(term), s.last_good_ledger[term] / incident, s.ledger[term] / incident);
  if (reason == StopReason::NotFinite)
    return fmt::format("the energies are not finite any more at step {}; {}", s.clock.step, change);
  return fmt::format("the energy balance is off by {:.4g} % of the incident energy at step {}; {}",
                     100.0 * s.ledger.closure_error(), s.clock.step, change);
}

}  // namespace knap
