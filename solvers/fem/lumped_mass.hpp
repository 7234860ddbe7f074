#pragma once
// Lumped masses whose sums are exact: corner masses are rounded to a common quantum, fine enough not to matter
// (relative 1e-13) and coarse enough that every sum over corners of one vertex is free of rounding. However a vertex is
// split, the masses of its nodes add up to what it was, bit for bit.
#include <span>

#include "core/topology.hpp"

namespace knap {

/// Mass of one corner of each tet [kg]: density [kg/m3] x volume [m3] / 4, both by tet, rounded as above.
std::vector<double> corner_masses(const Topology& topology, std::span<const double> volumes,
                                  std::span<const double> densities);
inline std::vector<double> corner_masses(const Topology& topology, std::span<const double> volumes, double density) {
  return corner_masses(topology, volumes, std::vector<double>(volumes.size(), density));
}

/// Mass of every node [kg] from the corners it has.
std::vector<double> lumped_masses(const Topology& topology, std::span<const double> corner_masses);

/// Mass [kg] of a node made of the given corners.
double corner_sum(std::span<const Index> corners, std::span<const double> corner_masses);

}  // namespace knap
