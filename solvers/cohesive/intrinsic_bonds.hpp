#pragma once
// Intrinsic insertion: every facet a cohesive element from the start, whose first branch is a spring of stiffness
// alpha M/h per area (Xu & Needleman 1994; the stiffness after Tomar, Zhai & Zhou 2004). Every corner has a node of its
// own, nothing ever splits. It softens the body by about 1/alpha and costs its time step: a cross-check of the
// extrinsic insertion, with the same criterion and, from the strength on, the same law. A facet that has reached its
// strength becomes a crack like any other.
#include <span>

#include "cohesive/cohesive_state.hpp"
#include "cohesive/insertion_criterion.hpp"
#include "core/nodal_state.hpp"

namespace knap {

/// The springs between twin nodes: of stiffness K along the facet's normal and K beta^2/kappa along the facet, so that
/// force and energy pass into the softening law without a step.
struct IntrinsicBonds {
  std::vector<double> stiffness;  ///< K by facet [Pa/m], 0 where the facet is none of them; empty if there are none
  std::vector<double> strength;   ///< by facet [Pa]
  bool empty() const { return stiffness.empty(); }
};

/// Gives every corner of the tets a node of its own. Mass, momentum and kinetic energy are kept exactly.
void part_corners(Topology& topology, NodalState& nodes, std::span<const Index> tets,
                  std::span<const double> corner_mass);

/// Adds to the stiffness of every corner [N/m], by corner, what dominates the springs there.
void add_bond_stiffnesses(const IntrinsicBonds& bonds, const Topology& topology, const LawsOfTets& laws,
                          std::span<const double> facet_area, std::span<double> corner_stiffness);

/// What the springs are at: their facets' reference areas [m2], and the laws.
struct BondScene {
  const Topology& topology;
  std::span<const Vec4> x;
  std::span<const double> facet_area;
  LawsOfTets laws;
};

/// Adds the forces of all bonds that hold to f [N].
void add_bond_forces(const IntrinsicBonds& bonds, const BondScene& scene, std::span<Vec4> f);
/// Energy stored in them [J].
double bond_energy(const IntrinsicBonds& bonds, const BondScene& scene);
/// A corner of a bond that has reached its strength.
struct BondCorner {
  double stiffness = 0.0;      ///< [Pa/m]
  double area = 0.0;           ///< a third of the facet [m2]
  Vec3 jump = Vec3::Zero();    ///< from minus to plus [m]
  Vec3 normal = Vec3::Zero();  ///< minus to plus
  double dt = 0.0;             ///< time step [s]
};
/// Takes its record, made with the strength and delta_c of a facet that was rigid so far, to where the spring has left
/// it: onto the softening branch, at the opening of the spring at the strength, or at its own where that is larger; the
/// impulse is what the spring bore beyond that branch. Returns the energy that the spring held and the record does
/// not [J].
double soften_bond(CrackRecord& record, const CohesiveLaw& law, const BondCorner& bond);

/// The bonds whose mean traction reaches their strength; ascending.
std::vector<OverloadedFacet> overloaded_bonds(const IntrinsicBonds& bonds, const BondScene& scene);

}  // namespace knap
