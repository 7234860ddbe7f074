#pragma once
// Impulses on twin nodes that have slipped act at two different points and so change the angular momentum by jump x
// impulse. Each face gives that back as a rigid rotation of its six nodes a few steps later, before the impulses of
// that step are solved; until then it is known as pending. (Giving it back after the solve would break what was just
// solved.)
#include <span>

#include "cohesive/cohesive_state.hpp"
#include "core/nodal_state.hpp"

namespace knap {

/// The unit normal of the mid-surface, minus to plus; that of the face when the mid-surface has collapsed.
Vec3 mid_surface_normal(const CrackFace& face, std::span<const Vec4> x);
/// Gives it to the face.
void update_normal(CrackFace& face, std::span<const Vec4> x);

/// The faces give back in so many turns, one a step; all_turns = all of them at once, before faces may end.
inline constexpr Index num_turns = 4;
inline constexpr Index all_turns = -1;

/// Once a step: normals of the faces that do not sleep, which of them have failed, and for those whose turn it is the
/// rotation that gives back the angular momentum they have taken (I w = -C over the six nodes).
void update_crack_faces(CrackState& cracks, Topology& topology, const NodalState& nodes, Index turn);

/// Angular momentum that a face has still to give back [kg m2/s].
Vec3 pending_couple(const CrackFace& face);
/// Angular momentum still to be given back [kg m2/s], positions as after the step.
Vec3 pending_angular_momentum(const CrackState& cracks);

}  // namespace knap
