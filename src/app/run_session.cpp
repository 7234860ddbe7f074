#include "app/run_session.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdio>

#include "app/interrupt.hpp"
#include "app/terminal.hpp"
#include "core/errors.hpp"
#include "core/parallel.hpp"
#include "simulation/persistent_arrays.hpp"

namespace knap {
namespace {

constexpr double rows_of_history = 500.0;
constexpr int standard_error = 2;

std::int64_t steps(double time, double dt) { return std::max<std::int64_t>(1, std::llround(time / dt)); }

ProgressOptions progress_options(const PreparedRun& run, RunLog& log) {
  ProgressOptions options{.end_time = run.identity.card.end_time, .end_is_expected = run.limits.automatic};
  if (is_terminal(standard_error)) {
    options.style = ProgressOptions::Style::Terminal;
    options.width = terminal_width(standard_error);
    options.show = [](const std::string& text) { std::fputs(text.c_str(), stderr); };
  } else {
    options.show = [&log](const std::string& line) { log.info(line); };
  }
  return options;
}

History make_history(const PreparedRun& run, const SessionOptions& options) {
  const double interval = options.output.history_interval.value_or(run.identity.card.end_time / rows_of_history);
  return {options.folder.history(), steps(interval, run.simulation.clock.dt), run.simulation.options.ledger_interval};
}

std::optional<VtkFrames> make_frames(const PreparedRun& run, const SessionOptions& options) {
  if (options.output.frames == 0) return std::nullopt;
  const double interval = run.identity.card.end_time / options.output.frames;
  return VtkFrames(options.folder.path, steps(interval, run.simulation.clock.dt), labels_by_size);
}

void restore(PreparedRun& run, History& history, std::optional<VtkFrames>& frames, const SessionOptions& options) {
  Simulation& s = run.simulation;
  const Checkpoint checkpoint = read_checkpoint(options.folder.checkpoint());
  try {
    restore_checkpoint(s, checkpoint);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", options.folder.checkpoint().string(), error.what()));
  }
  history.resume(s.clock.step, s.tools.size());
  if (frames) frames->resume(s.clock.step, s.clock.dt);
}

// The one whose file lets the run go on looks last, so that the others' files are never behind it.
std::vector<Observer*> in_order(std::initializer_list<Observer*> observers, std::optional<VtkFrames>& frames,
                                Checkpoints& checkpoints) {
  std::vector<Observer*> all(observers);
  if (frames) all.push_back(&*frames);
  all.push_back(&checkpoints);
  return all;
}

}  // namespace

Session run_session(PreparedRun& run, const SessionOptions& options, RunLog& log) {
  Simulation& s = run.simulation;
  History history = make_history(run, options);
  auto frames = make_frames(run, options);
  Checkpoints checkpoints(options.folder.checkpoint(), options.output.checkpoint_interval);
  Progress progress(progress_options(run, log));
  EnergyWatch energy([&log](const std::string& message) { log.warn(message); });
  if (options.resume) {
    restore(run, history, frames, options);
    log.info(fmt::format("Resuming at step {}, {:.4g} us", s.clock.step, 1e6 * s.clock.time()));
  }
  auto observers = in_order({&energy, &history}, frames, checkpoints);
  if (!options.quiet) {
    observers.push_back(&progress);
    log.before_printing([&progress] { progress.clear(); });
  }

  Session session{.first_step = s.clock.step, .is_resumed = options.resume, .threads = num_threads()};
  const auto start = std::chrono::steady_clock::now();
  session.stop_reason = knap::run(s, run.limits, observers, interrupt_requested());
  session.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!options.quiet) progress.finish(s);
  log.before_printing([] {});
  history.add_last_row(s);
  if (session.stop_reason == StopReason::Interrupted || options.keeps_end) checkpoints.write(s);
  return session;
}

}  // namespace knap
