#pragma once
#include "cohesive/cohesive_state.hpp"
#include "core/nodal_state.hpp"

namespace knap {

struct VertexImpulseOptions {
  CohesiveLaw law;
  double dt = 0.0;  ///< time step [s]
  int sweeps = 2;   ///< Gauss-Seidel sweeps over the records of a vertex
};

/// Cohesion, closure and friction of all crack records as impulses on the free velocities nodes.v (Moreau's non-smooth
/// dynamics, Jean 1999, with an initially rigid cohesive capacity). Damage grows here. Returns true if any did.
bool apply_vertex_impulses(CrackState& cracks, NodalState& nodes, const VertexImpulseOptions& options);

/// Books the work of this step's crack impulses once nodes.v is final; the velocity before the step is nodes.v_before.
void book_crack_losses(CrackState& cracks, const NodalState& nodes, const VertexImpulseOptions& options);

/// Energies of the cracks [J].
struct CrackEnergies {
  double stored = 0.0;    ///< recoverable, at the half step after positions x
  double cohesive = 0.0;  ///< dissipated by separation
  double closure = 0.0;
  double friction = 0.0;
  double cohesive_shear = 0.0;  ///< the part of `cohesive` spent in shear by softening records

  CrackEnergies& operator+=(const CrackEnergies& other);
};
CrackEnergies crack_energies(const CrackState& cracks, const NodalState& nodes, const VertexImpulseOptions& options);

}  // namespace knap
