#pragma once
// Gravity: a uniform acceleration of every node. Its energy is a function of the state, so nothing is summed up: at the
// half step the work done so far is exactly that of the way to x + dt/2 v.
#include "core/nodal_state.hpp"

namespace knap {

/// What gravity has given to the particle's momenta.
struct GravityImpulse {
  Vec3 linear = Vec3::Zero();   ///< [N s]
  Vec3 angular = Vec3::Zero();  ///< about the world's origin [N m s]

  GravityImpulse& operator+=(const GravityImpulse& other);
};

/// Adds dt times gravity [m/s2] to every nodal velocity.
GravityImpulse add_gravity(NodalState& nodes, const Vec3& gravity, double dt);

/// Of one node and a unit mass, `ahead` [s] after its position [J/kg].
double node_potential(const Vec3& gravity, const NodalState& nodes, Index node, double ahead);

/// Of all nodes [J].
double gravity_potential(const NodalState& nodes, const Vec3& gravity, double ahead);

}  // namespace knap
