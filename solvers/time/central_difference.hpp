#pragma once
// Leapfrog (Stoermer-Verlet): positions at whole steps, velocities at half steps.
#include <span>

#include "core/nodal_state.hpp"

namespace knap {

/// Keeps the velocities as nodes.v_before and adds dt f/m to nodes.v: the free velocity, before any impulse. Not those
/// of rigid bodies: body by node, none = of no body; so are nodes beyond the end.
void kick(NodalState& nodes, double dt, std::span<const Index> body_of_node = {});

/// Moves the nodes by dt v, but for those of rigid bodies.
void drift(NodalState& nodes, double dt, std::span<const Index> body_of_node = {});

/// Kinetic energy at the half step [J].
double kinetic_energy(const NodalState& nodes);

/// dt/2 f.v at the half step [J]: what turns the strain energy at x into that of the half step that follows; with it
/// the energy of a linear system is conserved exactly by leapfrog.
double half_step_work(const NodalState& nodes, double dt);

/// Linear momentum [kg m/s] and angular momentum about the origin [kg m2/s].
struct Momentum {
  Vec3 linear = Vec3::Zero();
  Vec3 angular = Vec3::Zero();
  double mass = 0.0;          ///< [kg]
  Vec3 first = Vec3::Zero();  ///< mass times position [kg m]

  Momentum& operator+=(const Momentum& other);
  Vec3 velocity() const { return linear / mass; }
  Vec3 centre() const { return first / mass; }
};
Momentum momentum(const NodalState& nodes);

}  // namespace knap
