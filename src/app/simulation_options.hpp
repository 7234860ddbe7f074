#pragma once
#include "config/run_config.hpp"
#include "simulation/options.hpp"

namespace knap {

/// How a particle of a case moves at the start [m/s].
Vec3 start_velocity(const RunConfig& config, const ParticleConfig& particle);

/// What a case asks of the solver, but for its tools, which stand where the particles are.
SimulationOptions simulation_options(const RunConfig& config);

}  // namespace knap
