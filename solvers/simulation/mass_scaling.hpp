#pragma once
#include "simulation/simulation.hpp"

namespace knap {

/// Adds mass to pieces of split vertices for which the time step would be more than the largest safe part of critical,
/// and books it in the totals.
void scale_masses(Simulation& s, std::span<const Index> split_vertices);

}  // namespace knap
