#include "app/run_results.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "app/compression_results.hpp"
#include "app/fragment_tables.hpp"
#include "app/report.hpp"
#include "app/run_picture.hpp"
#include "app/summary.hpp"
#include "app/terminal.hpp"

namespace knap {
namespace {

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
  write_fragments(folder.fragments(), outcome);
  write_size_distribution(folder.size_distribution(), outcome, s);
  write_compression(folder, outcome, options.output.picture, log);
  write_report(folder.report(), s, outcome);  // last: a run with a report has all its results
  if (options.output.picture && outcome.session.stop_reason != StopReason::Interrupted) draw(folder, s, outcome, log);
  show(summary(s, outcome, folder.path.string(), shows_utf8()), options.quiet, log);
}

// What the user should know about how it ended.
void tell_end(const Simulation& s, StopReason reason, RunLog& log) {
  if (reason == StopReason::EndTime && !has_touched_a_tool(s))
    log.warn(fmt::format("the particle had not reached {} at the end, {:.4g} us; a later run.end_time is needed",
                         s.tools.size() > 1 ? "any tool" : "the " + s.tools.front().name, 1e6 * s.clock.time()));
  if (exit_code(reason) == ExitCode::EnergyNotClosed) log.error(failure_message(s, reason));
}

}  // namespace

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

RunOutcome run_to_results(PreparedRun& run, const SessionOptions& options, RunLog& log) {
  const Session session = run_session(run, options, log);
  RunOutcome outcome = run_outcome(run.simulation, run.identity, session);
  outcome.compression = compression(run.simulation, run.identity, options.folder.history());
  write_results(run.simulation, outcome, options, log);
  tell_end(run.simulation, session.stop_reason, log);
  return outcome;
}

}  // namespace knap
