#pragma once
#include "io/vtk_writer.hpp"
#include "simulation/simulation.hpp"

namespace knap {

/// The surfaces of the tools where they are, with the number and the speed of each.
VtkGrid tool_grid(const Simulation& s);

}  // namespace knap
