#pragma once
#include "contact/contact_state.hpp"
#include "contact/tool.hpp"
#include "core/rigid_bodies.hpp"
#include "core/topology.hpp"

namespace knap {

/// What contacts are made of.
struct ContactScene {
  const Topology& topology;
  std::span<const Vec4> x;
  const RigidBodies& rigid;
  std::span<const Tool> tools{};
  double dt = 0.0;  ///< [s]
};

/// Updates contact.contacts: the points of those candidates that overlap now, and the nodes of rigid bodies that may
/// reach a tool in this step (those of deformable tets are landed by the tools themselves). Only candidates are looked
/// at whose fragments may have met by their travel. Two deformable tets share one point, a rigid body and another up to
/// three, to rest on. A contact that goes on keeps its impulse, turned with its normal.
void refresh_contacts(ContactState& contact, const ContactScene& scene);

/// Bound of the speed of a body's matter against any tool [m/s].
double fastest_against_tools(const RigidBody& body, std::span<const Tool> tools);

}  // namespace knap
