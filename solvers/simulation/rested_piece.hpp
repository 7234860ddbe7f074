#pragma once
#include "core/tet_mesh.hpp"
#include "simulation/initial_cracks.hpp"

namespace knap {

/// A piece of a particle when it has come to rest after a run: without strain, its cracks closed, their damage kept.
struct RestedPiece {
  TetMesh mesh;                         ///< as it lay in the particle before the run, facets in the same order [m]
  std::vector<double> facet_strength;   ///< of its facets [Pa]; empty in an unbreakable particle
  std::vector<double> fracture_energy;  ///< likewise [J/m2]
  std::vector<InitialCrack> cracks;     ///< ascending
};

/// The tets with this label, of a run with one particle. Tets that only broken ligaments join to them are gone, and so
/// are those ligaments.
RestedPiece rested_piece(const Simulation& s, std::span<const Index> label_of_tet, Index label);

/// A run of that piece, its mesh put where it starts. Throws as the other make_simulation.
Simulation make_simulation(const SimulationOptions& options, const RestedPiece& piece);

}  // namespace knap
