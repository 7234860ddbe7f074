#pragma once
#include <string>

#include "app/run_log.hpp"
#include "app/run_outcome.hpp"
#include "config/run_config.hpp"
#include "simulation/rested_piece.hpp"

namespace knap {

/// A run about to start: everything that is made before the first step.
struct PreparedRun {
  RunIdentity identity;
  RunLimits limits;
  Simulation simulation;
};

/// Meshes the particles of a case, places them and its tools, prints the sanity card. Throws InputError for what cannot
/// be run.
PreparedRun prepare_run(const RunConfig& config, const std::string& name, RunLog& log);

/// A piece of the case's particle, standing on the wall as its mesh lies, to be thrown as the case says. What the card
/// finds unresolved is only warned of.
PreparedRun prepare_run(RestedPiece piece, const RunConfig& config, const std::string& name, RunLog& log);

}  // namespace knap
