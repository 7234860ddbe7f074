#pragma once
#include <span>

#include "cohesive/cohesive_state.hpp"
#include "core/fragment_joint.hpp"

namespace knap {

/// When the twins of a failed facet stop being treated as facing each other, in units of the facet's size h.
struct HandOverOptions {
  double jump_everywhere = 0.3;             ///< at all three corners [h]
  double jump_somewhere = 0.6;              ///< at one corner [h]
  double jump_within = 1.0;                 ///< at all corners, even within one fragment: they do not meet any more [h]
  double overlap_let_go = 0.02;             ///< least overlap at a corner that keeps a fragment from letting go [h]
  std::span<const std::uint8_t> lets_go{};  ///< by tet, 1 = its fragment lets go of all others; empty = none does
  std::span<const double> facet_size;       ///< h = 1.5 (V_minus + V_plus)/A [m]
};

/// Hands over to the general contact every failed facet whose faces have moved apart or along each other that far, or
/// do not overlap where a fragment lets go: marks the face as ended, to be dropped when the step is done. Returns how
/// many.
Index hand_over_faces(CrackState& cracks, Topology& topology, std::span<const Vec4> x,
                      std::span<const Index> fragment_of_tet, const HandOverOptions& options);

/// Where cracks still join two fragments, sorted.
std::vector<FragmentJoint> fragment_joints(const CrackState& cracks, const Topology& topology,
                                           std::span<const Index> fragment_of_tet);

}  // namespace knap
