#pragma once
#include "app/run_log.hpp"
#include "app/run_outcome.hpp"
#include "config/run_config.hpp"
#include "simulation/simulation.hpp"

namespace knap {

/// Takes a run just made to the onset of fracture, with a line in the log for each load step. The same bits again for
/// the same run, so that a checkpoint of it can be restored afterwards.
OnsetStart start_from_onset(Simulation& s, const QuasistaticConfig& config, RunLog& log);

}  // namespace knap
