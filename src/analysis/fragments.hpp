#pragma once
// The pieces of a broken particle as numbers. Which tets belong together is the solver's decision (the labels); all
// sums run over corners of tets, not over nodes, because pieces of the damage label may still share nodes.
#include <span>

#include "core/types.hpp"

namespace knap {

/// A fragment of fewer tets is a product of the mesh: its mass is reported apart, never dropped.
inline constexpr Index min_resolved_tets = 10;

/// A connected piece of the particle. Motion is that of the lumped masses (a tet's mass in equal parts at its corners);
/// shape is that of the current positions. docs/breakage_measures.md defines every number.
struct Fragment {
  Index id = none;     ///< rank by mass: 0 is the largest
  Index particle = 0;  ///< that it was part of
  Index num_tets = 0;
  double mass = 0.0;             ///< [kg]
  double volume = 0.0;           ///< of the undeformed tets [m3]
  Vec3 centre = Vec3::Zero();    ///< of mass [m]
  Vec3 velocity = Vec3::Zero();  ///< of the centre [m/s]
  Vec3 spin = Vec3::Zero();      ///< I w = L about the centre [rad/s]
  Vec3 sizes = Vec3::Zero();     ///< of the box along the principal axes, descending [m]
  double sieve_size = 0.0;       ///< smallest square hole it passes [m]
  double surface = 0.0;          ///< area, cracks inside the fragment not counted [m2]
  double sphericity = 0.0;       ///< surface of the sphere of equal volume over `surface` [-]
  double elongation = 0.0;       ///< intermediate over longest size, 1 = equant [-]
  double flatness = 0.0;         ///< shortest over intermediate size, 1 = equant [-]
  double convexity = 0.0;        ///< volume over that of the convex hull [-]

  bool resolved() const { return num_tets >= min_resolved_tets; }
};

/// A labelled mesh in motion. The names of the first three are those of Topology.
struct FragmentInput {
  std::span<const TetCorners> tet_nodes;
  std::span<const TetCorners> tet_facets;
  std::span<const std::array<Index, 2>> facet_tets;
  std::span<const Vec4> x;                   ///< of the nodes [m]
  std::span<const Vec4> v;                   ///< of the nodes [m/s]
  std::span<const double> tet_volume;        ///< reference [m3]
  std::span<const double> densities;         ///< reference, by particle [kg/m3]
  std::span<const Index> label;              ///< of the tets, any ids from 0 on
  std::span<const Index> particle_of_tet{};  ///< empty = all of the first one
};

/// The labels renamed by descending volume (0 = the largest, ties by the lowest tet), without gaps: the ids of
/// find_fragments.
std::vector<Index> labels_by_size(std::span<const Index> label, std::span<const double> tet_volume);

/// All fragments, the largest first: fragment i has id i and the tets with labels_by_size(...) == i.
std::vector<Fragment> find_fragments(const FragmentInput& input);

}  // namespace knap
