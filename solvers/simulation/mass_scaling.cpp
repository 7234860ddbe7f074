#include "simulation/mass_scaling.hpp"

#include <algorithm>

#include "fem/stable_time_step.hpp"

namespace knap {
namespace {

// Pieces that splitting makes may come this near to their critical step before mass is added.
constexpr double largest_step_safety = 0.9;

// The corners of a vertex star that one node has.
std::vector<Index> corners_of_node(const Topology& topology, Index vertex, Index node) {
  std::vector<Index> corners;
  for (const Index corner : topology.corners_of_vertex[vertex])
    if (topology.node_of_corner(corner) == node) corners.push_back(corner);
  return corners;
}

}  // namespace

void scale_masses(Simulation& s, std::span<const Index> split_vertices) {
  const double critical = s.clock.dt / std::max(largest_step_safety, s.options.step_safety);
  for (const Index vertex : split_vertices)
    for (const Index corner : s.topology.corners_of_vertex[vertex]) {
      const Index node = s.topology.node_of_corner(corner);
      const auto corners = corners_of_node(s.topology, vertex, node);
      if (corners.front() != corner) continue;  // each node once
      const double needed = smallest_mass(corners, s.reference.corner_stiffness, critical);
      const double missing = needed - s.nodes.mass[at(node)];
      if (missing <= 0.0) continue;
      s.nodes.mass[at(node)] = needed;
      s.totals.added_mass += missing;
      const Vec3 added = missing * xyz(s.nodes.v[at(node)]);
      s.totals.added_linear += added;
      s.totals.added_angular += Vec3(xyz(s.nodes.x[at(node)])).cross(added);
      s.totals.mass_scaling_energy += 0.5 * missing * s.nodes.v[at(node)].squaredNorm() +
                                      missing * node_potential(s.options.gravity, s.nodes, node, -0.5 * s.clock.dt);
    }
}

}  // namespace knap
