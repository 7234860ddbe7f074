#include "fem/lumped_mass.hpp"

#include <algorithm>
#include <cmath>

namespace knap {

std::vector<double> corner_masses(const Topology& topology, std::span<const double> volumes,
                                  std::span<const double> densities) {
  std::vector<double> masses(volumes.size());
  std::transform(volumes.begin(), volumes.end(), densities.begin(), masses.begin(),
                 [](double v, double density) { return 0.25 * density * v; });
  double largest = 0.0;
  for (Index v = 0; v < topology.num_vertices(); ++v)
    largest = std::max(largest, corner_sum(topology.corners_of_vertex[v], masses));
  // Sums below 2^53 quanta are exact; one bit spare for the rounding of the corners.
  int exponent = 0;
  std::frexp(largest, &exponent);
  const double quantum = std::ldexp(1.0, exponent - 52);
  for (double& m : masses) m = std::max(1.0, std::round(m / quantum)) * quantum;
  return masses;
}

std::vector<double> lumped_masses(const Topology& topology, std::span<const double> corner_masses) {
  std::vector<double> masses(at(topology.num_nodes()), 0.0);
  for (Index t = 0; t < topology.num_tets(); ++t)
    for (const Index node : topology.tet_nodes[at(t)]) masses[at(node)] += corner_masses[at(t)];
  return masses;
}

double corner_sum(std::span<const Index> corners, std::span<const double> corner_masses) {
  double sum = 0.0;
  for (const Index corner : corners) sum += corner_masses[at(corner >> 2)];
  return sum;
}

}  // namespace knap
