#pragma once
#include "core/tet_mesh.hpp"
#include "simulation/simulation.hpp"

namespace knap {

/// A run at time 0, from a mesh placed where it starts. Throws InputError for a mesh that cannot be simulated.
Simulation make_simulation(const SimulationOptions& options, const TetMesh& mesh);

}  // namespace knap
