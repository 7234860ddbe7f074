#pragma once
#include <memory>
#include <optional>

#include "app/run_folder.hpp"
#include "app/run_log.hpp"
#include "app/run_outcome.hpp"
#include "observers/checkpoints.hpp"
#include "observers/energy_watch.hpp"
#include "observers/history.hpp"
#include "observers/progress.hpp"
#include "observers/vtk_frames.hpp"

namespace knap {

/// A run about to start: everything that is made before the first step.
struct PreparedRun {
  RunIdentity identity;
  RunLimits limits;
  Simulation simulation;
};

/// Where and how a session leaves its traces.
struct SessionOptions {
  RunFolder folder;
  OutputConfig output;
  bool resume = false;
  bool quiet = false;
};

/// Takes a run from where it is, or from its checkpoint, to its end or to an interrupt.
Session run_session(PreparedRun& run, const SessionOptions& options, RunLog& log);

}  // namespace knap
