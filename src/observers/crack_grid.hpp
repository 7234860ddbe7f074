#pragma once
#include "io/vtk_writer.hpp"
#include "simulation/simulation.hpp"

namespace knap {

/// The cracked facets as triangles half way between their two sides, with opening, damage, mode mixity (shear over all
/// work of separation, nan where not known any more) and FacetState. `displacement` leads back to the whole particle.
VtkGrid crack_grid(const Simulation& s);

}  // namespace knap
