#pragma once
#include <span>

#include "cohesive/linear_softening.hpp"
#include "core/tet_stress.hpp"
#include "core/topology.hpp"

namespace knap {

/// Effective traction [Pa] to compare with the strength: tension sqrt(t_n^2 + (t_t/beta)^2), compression
/// (|t_t| + mu_i t_n)/beta (Mohr-Coulomb with cohesion beta sigma_c).
double effective_traction(const CohesiveLaw& law, const Vec3& traction, const Vec3& normal);

/// A facet that must open.
struct OverloadedFacet {
  Index facet = none;
  double effective = 0.0;        ///< [Pa]
  Vec3 traction = Vec3::Zero();  ///< of the plus side on the minus side [Pa]
};

/// The laws of the particles that tets belong to.
struct LawsOfTets {
  std::span<const CohesiveLaw> laws;       ///< by particle
  std::span<const Index> particle_of_tet;  ///< may be empty if there is one

  const CohesiveLaw& of(Index tet) const { return laws.size() == 1 ? laws[0] : laws[at(particle_of_tet[at(tet)])]; }
};

/// The bonded facets whose mean traction of both tets, on the current normal, reaches their strength; ascending.
std::vector<OverloadedFacet> overloaded_facets(const Topology& topology, std::span<const Vec4> x,
                                               const TetStresses& stresses, std::span<const double> strength,
                                               const LawsOfTets& laws);

/// The bonded facet whose effective traction is the largest share of its strength, the first of equal ones; facet none
/// without any.
OverloadedFacet most_loaded_facet(const Topology& topology, std::span<const Vec4> x, const TetStresses& stresses,
                                  std::span<const double> strength, const LawsOfTets& laws);

}  // namespace knap
