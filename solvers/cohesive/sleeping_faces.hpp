#pragma once
#include <span>

#include "cohesive/cohesive_state.hpp"

namespace knap {

/// A cracked facet sleeps while both its tets belong to the same rigid body (bodies by tet, none = deformable): no
/// impulses, no damage, no rotation to give back. Its records keep their state, and the energies there still count.
/// Call it between two steps, when losses are settled.
void set_sleeping_faces(CrackState& cracks, const Topology& topology, std::span<const Index> body_of_tet);

}  // namespace knap
