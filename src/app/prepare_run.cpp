#include "app/prepare_run.hpp"

#include <fmt/format.h>

#include "app/case_tools.hpp"
#include "app/compression_results.hpp"
#include "app/onset_start.hpp"
#include "app/run_sanity.hpp"
#include "app/simulation_options.hpp"
#include "core/errors.hpp"
#include "simulation/make_simulation.hpp"

namespace knap {
namespace {

void check_card(const SanityCard& card, bool allow_unresolved, RunLog& log) {
  std::string reasons;
  for (const std::string& reason : refusals(card)) {
    if (allow_unresolved) log.warn(reason);
    reasons += (reasons.empty() ? "" : "\n") + reason;
  }
  if (!reasons.empty() && !allow_unresolved) throw InputError(reasons);
}

// What only the time step tells.
void check_times(const SanityCard& card, const RunConfig& config, const Simulation& s) {
  constexpr double most_steps = 1e9;
  const double dt = s.clock.dt;
  if (card.num_steps > most_steps)
    throw InputError(
        fmt::format("run.end_time: about {:.2g} steps of {:.3g} s to {:.3g} s, allowed are {:.0e}; a shorter "
                    "time, a larger run.step_safety or larger elements are needed",
                    card.num_steps, dt, card.end_time, most_steps));
  if (config.run.end_time && *config.run.end_time < dt)
    throw InputError(
        fmt::format("run.end_time = {} s: is shorter than one time step, {:.3g} s", *config.run.end_time, dt));
  for (const ParticleConfig& particle : config.particles)
    if (particle.material.viscous_ratio > 0.0 && particle.material.relaxation_time < dt)
      throw InputError(fmt::format("material.relaxation_time = {} s: must be at least the time step, {:.3g} s",
                                   particle.material.relaxation_time, dt));
}

std::vector<TetMesh> meshes_of(std::span<const ParticleMesh> particles) {
  std::vector<TetMesh> meshes;
  for (const ParticleMesh& particle : particles) meshes.push_back(particle.mesh);
  return meshes;
}

void log_mesh(const MeshQuality& quality, RunLog& log) {
  log.info(fmt::format("{} tets, {} nodes, shape quality {:.2f} mean, {:.2f} worst\n", quality.num_tets,
                       quality.num_vertices, quality.mean_shape, quality.min_shape));
}

SimulationOptions options_of(const RunConfig& config, std::span<const ParticleMesh> particles,
                             std::span<const TetMesh> meshes) {
  SimulationOptions options = simulation_options(config);
  for (std::size_t i = 0; i < particles.size(); ++i)
    if (auto& fracture = options.particles[i].fracture)
      fracture->law.kappa = mode_ii_ratio(config.particles[i], particles[i]);
  options.tools = tool_options(config, meshes, initial_gap(particles.front().contact_element_size));
  return options;
}

// The card of a run just made, shown and checked.
SanityCard checked_card(const RunConfig& config, const ParticleMesh& particle, const Simulation& s,
                        bool allow_unresolved, RunLog& log) {
  const SanityCard card = run_card(config, particle, s);
  log.info(format_sanity_card(card));
  check_card(card, allow_unresolved, log);
  check_times(card, config, s);
  return card;
}

}  // namespace

PreparedRun prepare_run(const RunConfig& config, const std::string& name, RunLog& log) {
  log.info("Meshing ...");
  std::vector<ParticleMesh> particles;
  for (const ParticleConfig& particle : config.particles) particles.push_back(make_particle_mesh(particle));
  const std::vector<TetMesh> meshes = meshes_of(particles);
  const MeshQuality quality = measure_quality(merged(meshes));
  log_mesh(quality, log);
  Simulation s = make_simulation(options_of(config, particles, meshes), meshes);
  const bool allow_unresolved = config.particles[0].fracture.allow_unresolved;
  RunIdentity identity{
      .case_name = name, .card = checked_card(config, particles.front(), s, allow_unresolved, log), .quality = quality};
  if (config.quasistatic.enabled) identity.onset = start_from_onset(s, config.quasistatic, log);
  for (std::size_t i = 0; i < particles.size(); ++i)
    identity.particles.push_back({config.particles[i].name, particles[i].diameter});
  RunLimits limits = run_limits(identity.card);
  limits.force_drop = force_drop(config, identity.card, s);
  return {std::move(identity), limits, std::move(s)};
}

PreparedRun prepare_run(RestedPiece piece, const RunConfig& config, const std::string& name, RunLog& log) {
  const ParticleMesh particle = particle_on_plane(std::move(piece.mesh));
  piece.mesh = particle.mesh;
  log_mesh(particle.quality, log);
  Simulation s = make_simulation(options_of(config, std::span(&particle, 1), std::span(&particle.mesh, 1)), piece);
  RunIdentity identity{.case_name = name,
                       .card = checked_card(config, particle, s, true, log),
                       .quality = particle.quality,
                       .particles = {{config.particles[0].name, particle.diameter}}};
  const RunLimits limits = run_limits(identity.card);
  return {std::move(identity), limits, std::move(s)};
}

}  // namespace knap
