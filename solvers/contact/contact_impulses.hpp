#pragma once
#include "contact/contact_state.hpp"
#include "contact/tool_contact.hpp"
#include "core/nodal_state.hpp"
#include "core/rigid_bodies.hpp"

namespace knap {

/// Friction by pair of particles.
struct PairFriction {
  std::span<const double> table;  ///< [-], row by row; empty = no matter which
  std::span<const Index> particle_of_tet;
  Index num_particles = 1;
};

struct ContactOptions {
  double friction = 0.0;  ///< Coulomb, without a table [-]
  PairFriction pairs{};
  double restitution =
      0.0;  ///< between rigid bodies, and of them on tools: speed of parting over speed of approach (Newton) [-]
  double slowest = 0.0;  ///< approach below this speed does not rebound [m/s]
  int sweeps = 2;        ///< Gauss-Seidel sweeps over all contacts, forwards and backwards in turn, at least
  int most_sweeps = 10;  ///< at most, if the impulses of deformable tets have not settled before
  int rigid_sweeps = 8;  ///< further ones over contacts with a rigid body, until they have settled; impulses are kept,
                         ///< so what is left settles in the steps that follow
  int rebounds = 50;     ///< rounds of impacts of rigid bodies in a step
};

/// Who can take part in a contact.
struct ContactParties {
  NodalState& nodes;
  RigidBodies& rigid;
  std::span<Tool> tools{};
  double dt = 0.0;        ///< [s]
  std::int64_t step = 0;  ///< number of the step: the first sweep of every other one goes backwards
};

/// Velocity of the second side relative to the first, at the contact's place [m/s].
Vec3 relative_velocity(const Contact& contact, const NodalState& nodes, const RigidBodies& rigid,
                       std::span<const Tool> tools);

/// Impulses that stop approaching contacts, with Coulomb friction, on nodes.v, the bodies' velocities and those of
/// guided tools: a contact only pushes, never more than stops the approach (or makes it rebound), so an overlap stays
/// and does not push apart. (Moreau 1988; Jean 1999.)
void apply_contact_impulses(ContactState& contact, const ContactParties& parties, const ContactOptions& options);

/// Adds the work of this step's contact impulses to contact.dissipated, once all velocities are final; that of tools is
/// in tool_deeds.
void book_contact_losses(ContactState& contact, const NodalState& nodes, const RigidBodies& rigid);

/// What the tools did to rigid bodies in this step.
std::vector<ToolDeed> tool_deeds(const ContactState& contact, const RigidBodies& rigid, std::span<const Tool> tools);

}  // namespace knap
