#pragma once
#include <span>

#include "cohesive/cohesive_state.hpp"
#include "core/nodal_state.hpp"

namespace knap {

/// Sets the unit normal of the mid-surface, minus to plus; kept when the mid-surface has collapsed.
void update_normal(CrackFace& face, std::span<const Vec4> x);

/// Once a step: normals of all faces, which of them have failed, and the rotation that gives back the angular momentum
/// which last step's impulses on twin nodes at two different points took (per face sum of jump x impulse; I w = -C over
/// its six nodes).
void update_crack_faces(CrackState& cracks, Topology& topology, const NodalState& nodes);

/// Adds to the velocities the rotations that update_crack_faces found. Linear momentum is unchanged.
void restore_angular_momentum(const CrackState& cracks, NodalState& nodes);

/// Angular momentum still to be given back [kg m2/s]: what the last step's impulses took.
Vec3 pending_angular_momentum(const CrackState& cracks);

}  // namespace knap
