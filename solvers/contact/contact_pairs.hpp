#pragma once
#include "contact/contact_state.hpp"
#include "core/rigid_bodies.hpp"
#include "core/topology.hpp"

namespace knap {

/// Updates contact.contacts: the points of those candidates that overlap now. Only candidates are looked at whose
/// fragments may have met by their travel. Two deformable tets share one point, a rigid body and another up to three,
/// to rest on. A contact that goes on keeps its impulse, turned with its normal.
void refresh_contacts(ContactState& contact, const Topology& topology, std::span<const Vec4> x,
                      const RigidBodies& rigid);

}  // namespace knap
