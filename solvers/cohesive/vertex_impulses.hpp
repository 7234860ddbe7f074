#pragma once
#include "cohesive/cohesive_state.hpp"
#include "core/nodal_state.hpp"

namespace knap {

struct VertexImpulseOptions {
  std::span<const CohesiveLaw> laws;  ///< by particle, see law_of_vertex
  double dt = 0.0;                    ///< time step [s]
  int sweeps = 2;                     ///< Gauss-Seidel sweeps over the records of a vertex
};

/// Cohesion, closure and friction of all crack records as impulses on the free velocities nodes.v (Moreau's non-smooth
/// dynamics, Jean 1999, with an initially rigid cohesive capacity), after the rotations that give back angular
/// momentum. Damage grows here. The losses are booked as if nothing else acted in this step.
void apply_vertex_impulses(CrackState& cracks, NodalState& nodes, const VertexImpulseOptions& options);

/// Books anew the losses of this step at the vertices of the given nodes, which other impulses have changed since; then
/// closes the books of the step.
void settle_crack_losses(CrackState& cracks, const Topology& topology, const NodalState& nodes,
                         const std::vector<Index>& changed_nodes, const VertexImpulseOptions& options);

/// Energies of the cracks [J].
struct CrackEnergies {
  double stored = 0.0;  ///< recoverable, at the half step after positions x
  CrackLosses losses;

  CrackEnergies& operator+=(const CrackEnergies& other);
};
CrackEnergies crack_energies(const CrackState& cracks, const NodalState& nodes, const VertexImpulseOptions& options);

}  // namespace knap
