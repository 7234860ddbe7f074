#pragma once
#include "fem/elastic_kernel.hpp"
#include "materials/material.hpp"

namespace knap {

/// The viscoelastic branch of all tets; empty without one. All of it is persistent state.
struct BranchState {
  std::vector<BranchGroup> groups;  ///< by lane group
  double decay = 1.0;               ///< half-step decay of the last force evaluation [-]
  double stored = 0.0;              ///< at the last force evaluation [J]
  double pending = 0.0;             ///< loss of the half step after it, booked by the next one [J]
  double dissipated = 0.0;          ///< up to the last force evaluation [J]
};

/// The bulk of the particle: what the sweeps over tets need, and the stress they leave.
struct ElasticForce {
  Material material;
  ElementBlocks blocks;
  std::vector<ElementGroup> groups;    ///< by lane group
  BranchState branch;                  ///< persistent
  std::vector<TetStress> stress;       ///< by tet, of the last update_stress
  std::vector<float> stress_bound;     ///< see TetStresses
  std::vector<Vec4> interface_forces;  ///< scratch, by interface slot [N]
};

/// From the reference positions [m] of the original vertices; throws InputError on a tet without positive volume.
ElasticForce make_elastic_force(const Topology& topology, std::span<const Vec3> reference_positions,
                                const Material& material);

/// Follows a split: the given tets have new nodes.
void refresh_elastic_force(ElasticForce& elastic, const Topology& topology, std::span<const Index> changed_tets);

/// OVERWRITES the force f [N] of every node with that of the bulk at positions x [m], and takes the viscoelastic branch
/// one step of dt [s] further (0 leaves it where it is). Call it once a step.
void update_elastic_forces(ElasticForce& elastic, std::span<const Vec4> x, std::span<Vec4> f, double dt);

/// Energy and compression of the bulk; x as in the last update_elastic_forces.
BulkState bulk_state(const ElasticForce& elastic, std::span<const Vec4> x);
/// Energy stored in the bulk [J], branch included; x as in the last update_elastic_forces.
double strain_energy(const ElasticForce& elastic, std::span<const Vec4> x);

/// Cauchy stress of all tets at x into elastic.stress and stress_bound; x as in the last update_elastic_forces.
void update_stress(ElasticForce& elastic, std::span<const Vec4> x);

}  // namespace knap
