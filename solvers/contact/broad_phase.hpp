#pragma once
#include "contact/contact_state.hpp"
#include "core/fragment_joint.hpp"
#include "core/nodal_state.hpp"
#include "core/rigid_bodies.hpp"
#include "core/topology.hpp"

namespace knap {

/// What a rebuild reads beside the contact's fragment labels.
struct ContactSurroundings {
  const Topology& topology;
  const NodalState& nodes;
  const RigidBodies& rigid;
  std::span<const FragmentJoint> joints;  ///< sorted
  double time_ahead = 0.0;                ///< for which fragments going on as they do stay within their margins [s]
};

/// Finds anew all pairs of tets with a free face, of different fragments, that may meet while every fragment travels no
/// further than its margin, which grows with its speed; sets all travels to zero.
void rebuild_candidates(ContactState& contact, const ContactSurroundings& here);

/// What moves fragments.
struct FragmentMotion {
  std::span<const Vec4> v;   ///< of the nodes [m/s]
  const RigidBodies& rigid;  ///< whole fragments
};

/// Adds the ways of the last drift, at these velocities for dt [s], to the fragments' travel; returns whether one has
/// gone beyond its margin, so that the candidates must be rebuilt.
bool advance_travel(ContactState& contact, const FragmentMotion& motion, double dt);

}  // namespace knap
