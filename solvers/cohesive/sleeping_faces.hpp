#pragma once
#include <span>

#include "cohesive/cohesive_state.hpp"

namespace knap {

/// The slots of the cracked facets between two of the given tets.
std::vector<Index> inner_faces(const CrackState& cracks, const Topology& topology, std::span<const Index> tets);

/// Angular momentum that the faces had still to give back [kg m2/s]; from now on it is the caller's.
Vec3 take_pending_couples(CrackState& cracks, std::span<const Index> slots);

/// Turns the impulses of the faces' records, as their body has turned while they slept.
void turn_impulses(CrackState& cracks, const Topology& topology, std::span<const Index> slots, const Mat3& rotation);

/// A cracked facet sleeps while both its tets belong to the same rigid body (bodies by tet, none = deformable): no
/// impulses, no damage, no rotation to give back. Its records keep their state, and the energies there still count.
/// Call it between two steps, when losses are settled.
void set_sleeping_faces(CrackState& cracks, const Topology& topology, std::span<const Index> body_of_tet);

}  // namespace knap
