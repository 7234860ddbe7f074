#pragma once
#include "app/run_session.hpp"
#include "core/errors.hpp"

namespace knap {

/// Throws a particle, then as often as the case says the largest piece of what was left, at rest again and with its
/// damage. Each impact is a run in a folder of its own; impacts.csv and impacts.png in that of the session tell all of
/// them. To resume, impacts that have ended are only read.
ExitCode run_repeated_impacts(PreparedRun first, const RunConfig& config, const SessionOptions& options, RunLog& log);

}  // namespace knap
