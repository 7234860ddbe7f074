#pragma once
// Motion of rigid bodies in the leapfrog step. Between impulses a body turns freely about its centre: an implicit
// midpoint step for the angular momentum in body axes, and for the orientation the Cayley rotation that belongs to it,
// keep angular momentum and kinetic energy exactly (both are quadratic invariants) at any step size. The midpoint rule
// follows the exact orbit at a slightly wrong pace; its leading error is known in closed form and taken off the inverse
// inertia beforehand, as Hairer & Vilmart (2006, J. Phys. A 39, "preprocessed discrete Moser-Veselov") do, which makes
// the step of fourth order at no cost. The alternative, the exact solution by elliptic functions, is dearer than all
// else that a body needs.
#include "core/rigid_bodies.hpp"

namespace knap {

/// Turns a body by dt [s] of free rotation.
void rotate_freely(RigidBody& body, double dt);

/// Keeps the momenta as those before the step and adds what an acceleration [m/s2] does in dt [s].
void kick(RigidBodies& rigid, const Vec3& acceleration, double dt);

/// Moves and turns all bodies by dt [s].
void drift(RigidBodies& rigid, double dt);

/// Positions and velocities of the bodies' nodes from the bodies.
void place_nodes(const RigidBodies& rigid, NodalState& nodes);

/// Velocities of the nodes of those bodies that kick or impulses have changed in this step.
void update_node_velocities(const RigidBodies& rigid, NodalState& nodes);

}  // namespace knap
