#pragma once
// Nodes that keep to a velocity along some axes of the world, whatever pulls at them: held faces, symmetry planes,
// jaws. They get the impulse it takes, whose work is exact at the half step: p.(v- + v+)/2.
#include <span>

#include "core/nodal_state.hpp"
#include "core/topology.hpp"

namespace knap {

/// Some vertices and how all their nodes move, those of later splits included.
struct PrescribedOptions {
  std::vector<Index> vertices{};               ///< original ones, each once
  std::array<bool, 3> axes{true, true, true};  ///< along which they are led; free along the others
  Vec3 velocity = Vec3::Zero();                ///< in the end; zero = held [m/s]
  double ramp_time = 0.0;                      ///< in which the velocity grows from 0, linearly [s]
};

/// What the run has done to the nodes so far.
struct PrescribedState {
  Vec3 impulse = Vec3::Zero();  ///< on the nodes [N s]
  double work = 0.0;            ///< on the particle [J]

  PrescribedState& operator+=(const PrescribedState& other);
};

struct PrescribedNodes {
  std::vector<bool> has_vertex;  ///< by original vertex
  std::vector<Index> nodes;      ///< derived: of these vertices, ascending
  Index known_nodes = 0;         ///< derived: how many nodes of the run have been looked at
  Vec3 velocity = Vec3::Zero();  ///< mean over the running step [m/s]
  PrescribedState state;
};

/// At time 0. Throws InputError for a vertex that there is not.
std::vector<PrescribedNodes> make_prescribed(std::span<const PrescribedOptions> options, Index num_vertices);

/// Begins a step at `time` [s]: finds nodes that have come since, and the velocity of the step.
void aim_nodes(std::span<PrescribedNodes> prescribed, std::span<const PrescribedOptions> options,
               const Topology& topology, double time, double dt);

/// Gives the nodes their velocities. May be repeated in a step, after other impulses; a tool that meets such a node
/// comes later and has the last word.
void lead_nodes(std::span<PrescribedNodes> prescribed, std::span<const PrescribedOptions> options, NodalState& nodes);

/// Everything that decides how a run goes on, to tell cases apart.
std::vector<double> defining_numbers(const PrescribedOptions& options);

}  // namespace knap
