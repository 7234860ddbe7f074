#pragma once
#include "io/vtk_writer.hpp"
#include "simulation/simulation.hpp"

namespace knap {

/// The cracked facets as triangles half way between their two sides, with opening, damage, mode mixity (angle of the
/// opening: 0 is pure opening, 1 pure shear) and FacetState. `displacement` leads back to the whole particle.
VtkGrid crack_grid(const Simulation& s);

}  // namespace knap
