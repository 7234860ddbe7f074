#pragma once
#include <memory>
#include <optional>

#include "app/prepare_run.hpp"
#include "app/run_folder.hpp"
#include "observers/checkpoints.hpp"
#include "observers/energy_watch.hpp"
#include "observers/history.hpp"
#include "observers/progress.hpp"
#include "observers/vtk_frames.hpp"

namespace knap {

/// Where and how a session leaves its traces.
struct SessionOptions {
  RunFolder folder;
  OutputConfig output;
  bool resume = false;
  bool quiet = false;
  bool keeps_end = false;  ///< a last checkpoint, of the end
};

/// Takes a run from where it is, or from its checkpoint, to its end or to an interrupt.
Session run_session(PreparedRun& run, const SessionOptions& options, RunLog& log);

}  // namespace knap
