#include <fmt/format.h>

#include <cstdio>

#include "app/case_tools.hpp"
#include "app/commands.hpp"
#include "app/compression_results.hpp"
#include "app/fragment_tables.hpp"
#include "app/interrupt.hpp"
#include "app/onset_start.hpp"
#include "app/report.hpp"
#include "app/run_picture.hpp"
#include "app/run_sanity.hpp"
#include "app/run_session.hpp"
#include "app/simulation_options.hpp"
#include "app/summary.hpp"
#include "app/terminal.hpp"
#include "config/load_config.hpp"
#include "core/parallel.hpp"
#include "simulation/make_simulation.hpp"
#include "version.hpp"

namespace knap {
namespace {

namespace fs = std::filesystem;

RunConfig load(const RunArguments& arguments) {
  auto overrides = arguments.overrides;
  if (arguments.threads) overrides.push_back(fmt::format("run.threads={}", *arguments.threads));
  return load_config(arguments.case_file, overrides);
}

std::string case_name(const RunArguments& arguments) { return arguments.case_file.stem().string(); }

void check_card(const SanityCard& card, const RunConfig& config, RunLog& log) {
  std::string reasons;
  for (const std::string& reason : refusals(card)) {
    if (config.particles[0].fracture.allow_unresolved) log.warn(reason);
    reasons += (reasons.empty() ? "" : "\n") + reason;
  }
  if (!reasons.empty() && !config.particles[0].fracture.allow_unresolved) throw InputError(reasons);
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

std::vector<TetMesh> meshes_of(const std::vector<ParticleMesh>& particles) {
  std::vector<TetMesh> meshes;
  for (const ParticleMesh& particle : particles) meshes.push_back(particle.mesh);
  return meshes;
}

PreparedRun prepare(const RunConfig& config, const std::string& name, RunLog& log) {
  log.info("Meshing ...");
  std::vector<ParticleMesh> particles;
  for (const ParticleConfig& particle : config.particles) particles.push_back(make_particle_mesh(particle));
  const std::vector<TetMesh> meshes = meshes_of(particles);
  const TetMesh all = merged(meshes);
  const MeshQuality quality = measure_quality(all);
  log.info(fmt::format("{} tets, {} nodes, shape quality {:.2f} mean, {:.2f} worst\n", quality.num_tets,
                       quality.num_vertices, quality.mean_shape, quality.min_shape));
  SimulationOptions options = simulation_options(config);
  options.tools = tool_options(config, meshes, initial_gap(particles.front().contact_element_size));
  Simulation s = make_simulation(options, meshes);
  const SanityCard card = run_card(config, particles.front(), s);
  log.info(format_sanity_card(card));
  check_card(card, config, log);
  check_times(card, config, s);
  RunIdentity identity{.case_name = name, .card = card, .quality = quality};
  if (config.quasistatic.enabled) identity.onset = start_from_onset(s, config.quasistatic, log);
  for (std::size_t i = 0; i < particles.size(); ++i)
    identity.particles.push_back({config.particles[i].name, particles[i].diameter});
  RunLimits limits = run_limits(card);
  limits.force_drop = force_drop(config, card, s);
  return {std::move(identity), limits, std::move(s)};
}

void draw(const RunFolder& folder, const Simulation& s, const RunOutcome& outcome, RunLog& log) {
  try {
    draw_run(folder.picture(), s, outcome);
  } catch (const RuntimeFailure& failure) {
    log.warn(fmt::format("no picture: {}", failure.what()));
  }
}

// The summary is the program's result, so it goes to standard output.
void show(const std::string& text, bool quiet, RunLog& log) {
  log.note(text);
  if (quiet) return;
  fmt::print("\n{}", text);
  std::fflush(stdout);
}

void write_compression(const RunFolder& folder, const RunOutcome& outcome, bool picture, RunLog& log) {
  if (!outcome.compression) return;
  write_force_displacement(folder.force_displacement(), *outcome.compression);
  if (!picture || outcome.compression->fracture.force == 0.0) return;
  try {
    draw_force_displacement(folder.force_plot(), *outcome.compression, outcome.case_name);
  } catch (const RuntimeFailure& failure) {
    log.warn(fmt::format("no plot: {}", failure.what()));
  }
}

void write_results(const Simulation& s, const RunOutcome& outcome, const SessionOptions& options, RunLog& log) {
  const RunFolder& folder = options.folder;
  write_report(folder.report(), s, outcome);
  write_fragments(folder.fragments(), outcome);
  write_size_distribution(folder.size_distribution(), outcome, s);
  write_compression(folder, outcome, options.output.picture, log);
  if (options.output.picture && outcome.session.stop_reason != StopReason::Interrupted) draw(folder, s, outcome, log);
  show(summary(s, outcome, folder.path.string(), shows_utf8()), options.quiet, log);
}

ExitCode exit_code(StopReason reason) {
  switch (reason) {
    case StopReason::AtRest:
    case StopReason::EndTime:
    case StopReason::ForceDropped:
      return ExitCode::Ok;
    case StopReason::Interrupted:
      return ExitCode::Interrupted;
    case StopReason::EnergyNotClosed:
    case StopReason::NotFinite:
      break;
  }
  return ExitCode::EnergyNotClosed;
}

ExitCode run_in_folder(PreparedRun& run, const SessionOptions& options, RunLog& log) {
  const Session session = run_session(run, options, log);
  RunOutcome outcome = run_outcome(run.simulation, run.identity, session);
  outcome.compression = compression(run.simulation, run.identity, options.folder.history());
  write_results(run.simulation, outcome, options, log);
  if (session.stop_reason == StopReason::EndTime && !has_touched_a_tool(run.simulation))
    log.warn(fmt::format("the particle had not reached {} at the end, {:.4g} us; a later run.end_time is needed",
                         run.simulation.tools.size() > 1 ? "any tool" : "the " + run.simulation.tools.front().name,
                         1e6 * run.simulation.clock.time()));
  const ExitCode code = exit_code(session.stop_reason);
  if (code == ExitCode::EnergyNotClosed) log.error(failure_message(run.simulation, session.stop_reason));
  if (code == ExitCode::Interrupted)
    log.warn(
        fmt::format("interrupted; to continue, give the same command with --resume and without --overwrite, --out {}",
                    options.folder.path.string()));
  return code;
}

FolderUse folder_use(const RunArguments& arguments) {
  if (arguments.resume) return FolderUse::Resume;
  return arguments.overwrite ? FolderUse::Overwrite : FolderUse::New;
}

}  // namespace

ExitCode run_command(const RunArguments& arguments) {
  const RunConfig config = load(arguments);
  const fs::path out = arguments.out.empty() ? fs::path("out") / case_name(arguments) : arguments.out;
  const PendingRunFolder pending(out, folder_use(arguments), config);
  set_num_threads(config.run.threads);
  catch_interrupts();
  RunLog log(arguments.quiet);
  log.info(fmt::format("Knap {}: {}", version, arguments.case_file.string()));
  PreparedRun run = prepare(config, case_name(arguments), log);
  if (interrupt_requested()) {
    log.warn("interrupted before the first step: nothing was written");
    return ExitCode::Interrupted;
  }
  const RunFolder folder = pending.start();
  log.start_file(folder.log());
  try {
    return run_in_folder(run, {folder, config.output, arguments.resume, arguments.quiet}, log);
  } catch (const std::exception& error) {
    log.note(fmt::format("ended by an error: {}", error.what()));
    throw;
  }
}

}  // namespace knap
