#include "loading/prescribed_nodes.hpp"

#include <fmt/format.h>

#include "core/errors.hpp"
#include "core/parallel.hpp"

namespace knap {
namespace {

// How much of the final velocity's time has passed: the way at `time` over that velocity [s].
double way_over_velocity(double ramp_time, double time) {
  return time < ramp_time ? 0.5 * time * time / ramp_time : time - 0.5 * ramp_time;
}

// Sets the velocity of a node along the axes.
PrescribedState lead(const PrescribedNodes& group, const std::array<bool, 3>& axes, NodalState& nodes, Index node) {
  PrescribedState done;
  for (int k = 0; k < 3; ++k) {
    if (!axes[at(k)]) continue;
    double& v = nodes.v[at(node)][k];
    done.impulse[k] = nodes.mass[at(node)] * (group.velocity[k] - v);
    done.work += 0.5 * done.impulse[k] * (group.velocity[k] + nodes.v_before[at(node)][k]);
    v = group.velocity[k];
  }
  return done;
}

}  // namespace

PrescribedState& PrescribedState::operator+=(const PrescribedState& other) {
  impulse += other.impulse;
  work += other.work;
  return *this;
}

std::vector<PrescribedNodes> make_prescribed(std::span<const PrescribedOptions> options, Index num_vertices) {
  std::vector<PrescribedNodes> all;
  for (const PrescribedOptions& group : options) {
    all.emplace_back().has_vertex.assign(at(num_vertices), false);
    for (const Index vertex : group.vertices) {
      if (vertex < 0 || vertex >= num_vertices)
        throw InputError(fmt::format("prescribed nodes: there is no vertex {} among {}", vertex, num_vertices));
      all.back().has_vertex[at(vertex)] = true;
    }
  }
  return all;
}

void aim_nodes(std::span<PrescribedNodes> prescribed, std::span<const PrescribedOptions> options,
               const Topology& topology, double time, double dt) {
  for (std::size_t i = 0; i < prescribed.size(); ++i) {
    PrescribedNodes& group = prescribed[i];
    for (; group.known_nodes < topology.num_nodes(); ++group.known_nodes)
      if (group.has_vertex[at(topology.vertex_of_node[at(group.known_nodes)])])
        group.nodes.push_back(group.known_nodes);
    const double ramp_time = options[i].ramp_time;
    const double share = (way_over_velocity(ramp_time, time + dt) - way_over_velocity(ramp_time, time)) / dt;
    group.velocity = share * options[i].velocity;
  }
}

void lead_nodes(std::span<PrescribedNodes> prescribed, std::span<const PrescribedOptions> options, NodalState& nodes) {
  for (std::size_t i = 0; i < prescribed.size(); ++i) {
    PrescribedNodes& group = prescribed[i];
    group.state += ordered_sum<PrescribedState>(
        to_index(group.nodes.size()), [&](Index k) { return lead(group, options[i].axes, nodes, group.nodes[at(k)]); });
  }
}

std::vector<double> defining_numbers(const PrescribedOptions& options) {
  std::vector<double> numbers(options.vertices.begin(), options.vertices.end());
  for (int k = 0; k < 3; ++k) numbers.insert(numbers.end(), {options.axes[at(k)] ? 1.0 : 0.0, options.velocity[k]});
  numbers.push_back(options.ramp_time);
  return numbers;
}

}  // namespace knap
