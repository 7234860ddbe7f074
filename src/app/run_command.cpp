#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <memory>

#include "app/commands.hpp"
#include "app/fragment_tables.hpp"
#include "app/interrupt.hpp"
#include "app/report.hpp"
#include "app/run_folder.hpp"
#include "app/run_picture.hpp"
#include "app/run_sanity.hpp"
#include "app/simulation_options.hpp"
#include "app/summary.hpp"
#include "app/terminal.hpp"
#include "config/load_config.hpp"
#include "core/log.hpp"
#include "core/parallel.hpp"
#include "observers/checkpoints.hpp"
#include "observers/energy_watch.hpp"
#include "observers/history.hpp"
#include "observers/progress.hpp"
#include "observers/vtk_frames.hpp"
#include "simulation/make_simulation.hpp"
#include "simulation/persistent_arrays.hpp"
#include "version.hpp"

namespace knap {
namespace {

namespace fs = std::filesystem;
using Log = spdlog::logger;

constexpr double rows_of_history = 500.0;
constexpr int standard_error = 2;

RunConfig load(const RunArguments& arguments) {
  auto overrides = arguments.overrides;
  if (arguments.threads) overrides.push_back(fmt::format("run.threads={}", *arguments.threads));
  return load_config(arguments.case_file, overrides);
}

// A run about to start: everything that is made before the first step.
struct Prepared {
  RunIdentity identity;
  RunLimits limits;
  Simulation simulation;
};

void check_card(const SanityCard& card, const RunConfig& config, Log& log) {
  std::string reasons;
  for (const std::string& reason : refusals(card)) {
    if (config.fracture.allow_unresolved) log.warn("warning: {}", reason);
    reasons += (reasons.empty() ? "" : "\n") + reason;
  }
  if (!reasons.empty() && !config.fracture.allow_unresolved) throw InputError(reasons);
}

Prepared prepare(const RunConfig& config, const std::string& case_name, Log& log) {
  log.info("Meshing ...");
  const ParticleMesh particle = make_particle_mesh(config);
  log.info("{} tets, {} nodes, worst shape quality {:.3f}", particle.quality.num_tets, particle.quality.num_vertices,
           particle.quality.min_shape);
  Simulation s = make_simulation(simulation_options(config), particle.mesh);
  const SanityCard card = run_card(config, particle, s);
  log.info("{}", format_sanity_card(card));
  check_card(card, config, log);
  return {{case_name, card, particle.quality}, run_limits(card), std::move(s)};
}

std::int64_t steps(double time, double dt) { return std::max<std::int64_t>(1, std::llround(time / dt)); }

// The observers of a run, in the order in which they look: the checkpoint last.
struct Observers {
  Progress progress;
  EnergyWatch energy;
  History history;
  std::optional<VtkFrames> frames;
  Checkpoints checkpoints;

  std::vector<Observer*> list(bool quiet) {
    std::vector<Observer*> all{&energy, &history};
    if (frames) all.push_back(&*frames);
    all.push_back(&checkpoints);
    if (!quiet) all.push_back(&progress);
    return all;
  }
};

ProgressOptions progress_options(const Prepared& run, Log& log) {
  ProgressOptions options{.end_time = run.identity.card.end_time, .end_is_expected = run.limits.automatic};
  if (is_terminal(standard_error)) {
    options.style = ProgressOptions::Style::Terminal;
    options.width = terminal_width(standard_error);
    options.show = [](const std::string& text) { std::fputs(text.c_str(), stderr); };
  } else {
    options.show = [&log](const std::string& line) { log.info("{}", line); };
  }
  return options;
}

std::unique_ptr<Observers> make_observers(const RunConfig& config, const RunFolder& folder, const Prepared& run,
                                          Log& log) {
  const double dt = run.simulation.clock.dt;
  const double expected = run.identity.card.end_time;
  const std::int64_t row_steps = steps(config.output.history_interval.value_or(expected / rows_of_history), dt);
  auto observers = std::make_unique<Observers>(
      Observers{.progress = Progress(progress_options(run, log)),
                .energy = EnergyWatch({}),
                .history = History(folder.history(), row_steps, run.simulation.options.ledger_interval),
                .frames = std::nullopt,
                .checkpoints = Checkpoints(folder.checkpoint(), config.output.checkpoint_interval)});
  if (config.output.frames > 0)
    observers->frames.emplace(folder.path, steps(expected / config.output.frames, dt), labels_by_size);
  Progress& progress = observers->progress;
  observers->energy = EnergyWatch([&log, &progress](const std::string& message) {
    progress.clear();
    log.warn("warning: {}", message);
  });
  return observers;
}

void resume(Prepared& run, Observers& observers, const RunFolder& folder, Log& log) {
  Simulation& s = run.simulation;
  restore_checkpoint(s, read_checkpoint(folder.checkpoint()));
  observers.history.resume(s.clock.step);
  if (observers.frames) observers.frames->resume(s.clock.step, s.clock.dt);
  log.info("Resuming at step {}, {:.4g} us", s.clock.step, 1e6 * s.clock.time());
}

Session run_session(Prepared& run, Observers& observers, bool quiet) {
  Simulation& s = run.simulation;
  Session session{.first_step = s.clock.step, .threads = num_threads()};
  const auto start = std::chrono::steady_clock::now();
  session.stop_reason = knap::run(s, run.limits, observers.list(quiet), interrupt_requested());
  session.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  observers.history.add_last_row(s);
  if (!quiet) observers.progress.finish(s);
  if (session.stop_reason == StopReason::Interrupted) observers.checkpoints.write(s);
  return session;
}

ExitCode exit_code(StopReason reason) {
  switch (reason) {
    case StopReason::AtRest:
    case StopReason::EndTime:
      return ExitCode::Ok;
    case StopReason::Interrupted:
      return ExitCode::Interrupted;
    case StopReason::EnergyNotClosed:
      return ExitCode::EnergyNotClosed;
    case StopReason::NotFinite:
      break;
  }
  return ExitCode::EnergyNotClosed;
}

// On a terminal the summary is the program's result, so it goes to standard output; the log file has it too.
void show_summary(const std::string& text, bool quiet, Log& log) {
  Log file("file", log.sinks().back());
  file.info("{}", text);
  if (quiet) return;
  fmt::print("{}", text);
  std::fflush(stdout);
}

void write_results(const RunConfig& config, const RunFolder& folder, const Prepared& run, const Session& session,
                   Log& log, bool quiet) {
  const Simulation& s = run.simulation;
  const RunOutcome outcome = run_outcome(s, run.identity, session);
  write_report(folder.report(), s, outcome);
  write_fragments(folder.fragments(), outcome);
  write_size_distribution(folder.size_distribution(), outcome, s);
  if (config.output.picture && session.stop_reason != StopReason::Interrupted) {
    try {
      draw_run(folder.picture(), s, outcome);
    } catch (const RuntimeFailure& failure) {
      log.warn("warning: no picture: {}", failure.what());
    }
  }
  show_summary(summary(s, outcome, folder.path.string(), shows_utf8()), quiet, log);
}

ExitCode run_in_folder(const RunConfig& config, const RunFolder& folder, const RunArguments& arguments, Log& log) {
  log.info("Knap {}: {}", version, arguments.case_file.string());
  Prepared run = prepare(config, arguments.case_file.stem().string(), log);
  const auto observers = make_observers(config, folder, run, log);
  if (arguments.resume) resume(run, *observers, folder, log);
  const Session session = run_session(run, *observers, arguments.quiet);
  write_results(config, folder, run, session, log, arguments.quiet);
  const ExitCode code = exit_code(session.stop_reason);
  if (code == ExitCode::EnergyNotClosed) log.error("error: {}", failure_message(run.simulation, session.stop_reason));
  if (code == ExitCode::Interrupted)
    log.warn("interrupted; continue with: knap run {} --out {} --resume", arguments.case_file.string(),
             folder.path.string());
  return code;
}

}  // namespace

ExitCode run_command(const RunArguments& arguments) {
  const RunConfig config = load(arguments);
  const FolderUse use = arguments.resume      ? FolderUse::Resume
                        : arguments.overwrite ? FolderUse::Overwrite
                                              : FolderUse::New;
  const fs::path out = arguments.out.empty() ? fs::path("out") / arguments.case_file.stem() : arguments.out;
  const RunFolder folder = open_run_folder(out, use, config);
  set_num_threads(config.run.threads);
  catch_interrupts();
  const auto log = make_log(folder.log(), arguments.quiet);
  try {
    return run_in_folder(config, folder, arguments, *log);
  } catch (const InputError&) {
    if (!arguments.resume) remove_run(folder);  // nothing has run: leave no folder in the way of the next try
    throw;
  } catch (const std::exception& error) {
    Log("file", log->sinks().back()).error("{}", error.what());
    throw;
  }
}

}  // namespace knap
