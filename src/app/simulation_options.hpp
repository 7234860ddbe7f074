#pragma once
#include "config/run_config.hpp"
#include "simulation/options.hpp"

namespace knap {

/// What a case asks of the solver; the wall is the plane z = 0.
SimulationOptions simulation_options(const RunConfig& config);

}  // namespace knap
