#pragma once
#include <span>

#include "core/tet_mesh.hpp"
#include "simulation/simulation.hpp"

namespace knap {

/// A run at time 0, from the mesh of each particle, placed where it starts. Throws InputError for a mesh that cannot be
/// simulated.
Simulation make_simulation(const SimulationOptions& options, std::span<const TetMesh> meshes);
inline Simulation make_simulation(const SimulationOptions& options, const TetMesh& mesh) {
  return make_simulation(options, std::span(&mesh, 1));
}

/// Begins the balances of energy and momenta anew, for a state that has been changed since it was made. Velocities are
/// those of half a step before nodes.x, forces those at nodes.x.
void balance_from_here(Simulation& s);

}  // namespace knap
