#pragma once
#include <functional>
#include <span>

#include "io/vtk_writer.hpp"
#include "simulation/simulation.hpp"

namespace knap {

/// Renames labels of tets, e.g. by descending size, given the volumes of the tets [m3].
using Relabel = std::function<std::vector<Index>(std::span<const Index>, std::span<const double>)>;

/// The deformed particle with fragment ids by both labels, stress, damage, velocity and displacement. The stress is of
/// the positions shown.
VtkGrid particle_grid(const Simulation& s, const Relabel& relabel);

}  // namespace knap
