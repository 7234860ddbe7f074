#pragma once
#include "app/run_session.hpp"
#include "core/errors.hpp"

namespace knap {

/// Takes a prepared run to its end and writes all its results into the folder of the session.
RunOutcome run_to_results(PreparedRun& run, const SessionOptions& options, RunLog& log);

/// What the program ends with after a run that stopped for this reason.
ExitCode exit_code(StopReason reason);

}  // namespace knap
