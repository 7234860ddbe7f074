#pragma once
#include "quasistatic/load_path.hpp"
#include "simulation/simulation.hpp"

namespace knap {

/// Lets a run just made begin at the onset of fracture, for a particle at rest between two flat tools of which at least
/// one comes on at a constant velocity: what is elastic before is solved on equilibria. At time 0 then the particle
/// moves as its equilibria do at the speed of the tools, the tools stand where they press it so, a viscoelastic branch
/// has relaxed, and the energy that the run starts with, and is balanced against, is what is stored. The tools' work so
/// far is not counted. Gravity plays no part in it. Throws InputError where the case is another one.
Onset start_at_onset(Simulation& s, const LoadPathOptions& options = {});

}  // namespace knap
