#pragma once
#include "config/run_config.hpp"

namespace knap {

/// Volume of the shape [m3]; 0 for a mesh file.
double particle_volume(const ParticleConfig& particle);

/// Smallest extent of the shape along x, y, z [m]; 0 for a mesh file.
double smallest_extent(const ParticleConfig& particle);

/// Tets of its mesh, to expect; not of a mesh file.
double estimated_num_tets(const ParticleConfig& particle);

/// Fills the derived values that are still 0: element sizes, contact extent, and the fracture energy
/// G_c = K_IC^2 (1 - nu^2)/E (Irwin 1957, plane strain) when toughness is given.
void add_derived_values(RunConfig& config);

}  // namespace knap
