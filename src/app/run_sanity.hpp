#pragma once
#include "analysis/sanity_card.hpp"
#include "app/particle_mesh.hpp"
#include "simulation/run.hpp"
#include "simulation/simulation.hpp"

namespace knap {

/// The card of a case before a run is made of it, by its first particle: nominal element sizes and the expected number
/// of tets, or the mesh that the case brings; the time step is estimated.
SanityCard expected_card(const RunConfig& config);
/// The card of a run about to start, by its first particle; times a few steps of a copy of it.
SanityCard run_card(const RunConfig& config, const ParticleMesh& particle, const Simulation& s);

/// Of a particle on its mesh: fracture.mode_ii_ratio, or what fracture.crushed_zone_facets makes of it.
double mode_ii_ratio(const ParticleConfig& particle, const ParticleMesh& mesh);

/// When a run with this card ends: at the given time, else by itself, at the latest after 50 d/c_p, or 20 d/c_p after
/// the contact of an elastic particle where that is later.
RunLimits run_limits(const SanityCard& card);

}  // namespace knap
