#pragma once
#include "contact/contact_state.hpp"
#include "core/nodal_state.hpp"

namespace knap {

struct ContactOptions {
  double friction = 0.0;  ///< Coulomb [-]
  int sweeps = 4;         ///< Gauss-Seidel sweeps
};

/// Impulses that stop approaching contacts, with Coulomb friction, on nodes.v: a contact only pushes, never more than
/// stops the approach, so an overlap stays and does not push apart.
void apply_contact_impulses(ContactState& contact, NodalState& nodes, const ContactOptions& options);

/// Adds the work of this step's contact impulses to contact.dissipated, once nodes.v is final.
void book_contact_losses(ContactState& contact, const NodalState& nodes);

}  // namespace knap
