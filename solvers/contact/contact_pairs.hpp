#pragma once
#include "contact/contact_scene.hpp"
#include "contact/contact_state.hpp"

namespace knap {

/// Updates contact.contacts: the points of those candidates that overlap now, and the nodes of rigid bodies that may
/// reach a tool in this step (those of deformable tets are landed by the tools themselves). Only candidates are looked
/// at whose fragments may have met by their travel. Two deformable tets share one point, a rigid body and another up to
/// three, to rest on. A contact that goes on keeps its impulse, turned with its normal.
void refresh_contacts(ContactState& contact, const ContactScene& scene);

/// Between two looks: the points of tets move with the first of the two, those on tools are found anew.
void follow_contacts(ContactState& contact, const ContactScene& scene);

/// Bound of the speed of a body's matter against any tool [m/s].
double fastest_against_tools(const RigidBody& body, std::span<const Tool> tools);

}  // namespace knap
