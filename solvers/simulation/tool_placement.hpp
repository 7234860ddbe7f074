#pragma once
#include "simulation/simulation.hpp"

namespace knap {

/// Throws InputError that names tool and depth if the particle starts inside a tool or a tool inside the particle.
void check_tools_are_outside(const Simulation& s);

}  // namespace knap
