#pragma once
#include <span>

#include "cohesive/cohesive_state.hpp"
#include "cohesive/insertion_criterion.hpp"
#include "core/nodal_state.hpp"

namespace knap {

/// What insertion needs beside the state itself.
struct InsertionOptions {
  double dt = 0.0;                          ///< time step [s]
  std::span<const double> fracture_energy;  ///< mode I, per facet [J/m2]
  std::span<const double> facet_area;       ///< reference [m2]
  std::span<const double> corner_mass;      ///< per tet, a quarter of its mass [kg]
  std::span<const TetStress> stress;        ///< per tet
  LawsOfTets laws{};
  std::span<const double> bond_stiffness{};  ///< per facet, of IntrinsicBonds [Pa/m]; empty = all facets were rigid
};

/// What insertion changed, each list ascending and without repeats.
struct InsertionChange {
  std::vector<Index> split_vertices;
  std::vector<Index> changed_tets;
};

/// Opens the facets: new cohesive records, and a node for every group of tets that no bonded facet joins any more.
/// Mass, momentum and kinetic energy are kept exactly; a record that becomes active starts with the impulse that the
/// stresses transmit there. Intrinsic bonds, whose nodes are apart already, become softening records.
InsertionChange insert_cracks(CrackState& cracks, Topology& topology, NodalState& nodes,
                              std::span<const OverloadedFacet> facets, const InsertionOptions& options);

/// Gives every group of the vertex star's corners that bonded facets join a node of its own; returns the tets whose
/// nodes changed. The first group of a node keeps it and what scaling has added to its mass, the others
/// get copies; masses are summed from the corners.
std::vector<Index> split_vertex(Topology& topology, NodalState& nodes, Index vertex,
                                std::span<const double> corner_mass);

}  // namespace knap
