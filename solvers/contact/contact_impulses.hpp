#pragma once
#include "contact/contact_state.hpp"
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
  double restitution = 0.0;  ///< between rigid bodies: speed of parting over speed of approach (Newton) [-]
  double slowest = 0.0;      ///< approach below this speed does not rebound [m/s]
  int sweeps = 4;            ///< Gauss-Seidel sweeps over all contacts
  int rigid_sweeps = 50;     ///< further ones over contacts with a rigid body, until they have settled
};

/// Impulses that stop approaching contacts, with Coulomb friction, on nodes.v and the bodies' velocities: a contact
/// only pushes, never more than stops the approach (or makes it rebound), so an overlap stays and does not push apart.
/// (Moreau 1988; Jean 1999.)
void apply_contact_impulses(ContactState& contact, NodalState& nodes, RigidBodies& rigid,
                            const ContactOptions& options);

/// Adds the work of this step's contact impulses to contact.dissipated, once all velocities are final.
void book_contact_losses(ContactState& contact, const NodalState& nodes, const RigidBodies& rigid);

}  // namespace knap
