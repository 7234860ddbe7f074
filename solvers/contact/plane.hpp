#pragma once
#include "core/nodal_state.hpp"

namespace knap {

/// A rigid half space at rest; the particle is on the side its normal points to.
struct Plane {
  Vec3 point = Vec3::Zero();    ///< [m]
  Vec3 normal = Vec3::UnitZ();  ///< unit
  double friction = 0.0;        ///< Coulomb [-]
};

/// What a tool did to the particle in one step.
struct ToolAction {
  Vec3 impulse = Vec3::Zero();  ///< on the particle [N s]
  Vec3 moment = Vec3::Zero();   ///< about the origin [N m s]
  double friction_loss = 0.0;   ///< [J]
  double impact_loss = 0.0;     ///< kinetic energy of nodes stopped on the surface [J]
  std::vector<Index> nodes;     ///< touching, ascending

  ToolAction& operator+=(const ToolAction& other);
};

/// Exact unilateral contact of every node: where the step would end behind the plane, the impulse that makes it end on
/// it, with Coulomb friction. Must be the last impulse of a step: the losses are taken at the final velocities.
ToolAction apply_plane(const Plane& plane, NodalState& nodes, double dt);

}  // namespace knap
