#pragma once
#include "fem/elastic_kernel.hpp"
#include "materials/material.hpp"

namespace knap {

/// The viscoelastic branch of all tets; empty without one. All of it is persistent state.
struct BranchState {
  std::vector<BranchGroup> groups;  ///< by lane group, of the tets that do not sleep
  std::vector<std::array<double, 6>>
      remembered;           ///< the same by tet, valid where it sleeps; empty before any has slept
  double dt = 0.0;          ///< step of the last force evaluation [s]
  double stored = 0.0;      ///< at the last force evaluation [J]
  double pending = 0.0;     ///< loss of the half step after it, booked by the next one [J]
  double dissipated = 0.0;  ///< up to the last force evaluation [J]
};

/// The bulk of the particles: what the sweeps over tets need, and the stress they leave.
struct ElasticForce {
  std::vector<Material> materials;
  ElementBlocks blocks;
  std::vector<ElementGroup> groups;    ///< by lane group
  BranchState branch;                  ///< persistent
  std::vector<TetStress> stress;       ///< by tet, of the last update_stress; zero where it sleeps
  std::vector<float> stress_bound;     ///< see TetStresses
  std::vector<Vec4> interface_forces;  ///< scratch, by interface slot [N]
};

/// From the reference positions [m] of the original vertices, with the material of each tet (none given: the first
/// one). Throws InputError on a tet without positive volume.
ElasticForce make_elastic_force(const Topology& topology, std::span<const Vec3> reference_positions,
                                std::span<const Material> materials, std::span<const Index> material_of_tet = {});
inline ElasticForce make_elastic_force(const Topology& topology, std::span<const Vec3> reference_positions,
                                       const Material& material) {
  return make_elastic_force(topology, reference_positions, std::span(&material, 1));
}

/// Follows a split: the given tets have new nodes.
void refresh_elastic_force(ElasticForce& elastic, const Topology& topology, std::span<const Index> changed_tets);

/// OVERWRITES the force f [N] of every node with that of the bulk at positions x [m], zero where all tets sleep, and
/// takes the viscoelastic branch one step of dt [s] further (0 leaves it where it is). Call it once a step.
void update_elastic_forces(ElasticForce& elastic, std::span<const Vec4> x, std::span<Vec4> f, double dt);

/// Energy and compression of the bulk; x as in the last update_elastic_forces.
BulkState bulk_state(const ElasticForce& elastic, std::span<const Vec4> x);
/// Energy stored in the bulk [J], branch included; x as in the last update_elastic_forces.
double strain_energy(const ElasticForce& elastic, std::span<const Vec4> x);

/// Cauchy stress of the tets that do not sleep at x into elastic.stress and stress_bound; x as in the last
/// update_elastic_forces.
void update_stress(ElasticForce& elastic, std::span<const Vec4> x);

}  // namespace knap
