#pragma once
#include <string>

#include "io/checkpoint.hpp"
#include "simulation/simulation.hpp"

namespace knap {

/// Everything that a run has changed since make_simulation, ready to be written.
Checkpoint make_checkpoint(const Simulation& s);

/// Puts a run just made from the same case back to where the checkpoint was taken; it goes on with the same bits.
/// Throws InputError if the checkpoint is not of this case and mesh.
void restore_checkpoint(Simulation& s, const Checkpoint& checkpoint);

/// Hash of the same data as 16 hex digits: equal for equal bits of the whole state.
std::string state_hash(const Simulation& s);

}  // namespace knap
