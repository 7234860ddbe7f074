#pragma once
#include "cohesive/cohesive_state.hpp"

namespace knap {

/// Which facets hold a fragment together.
enum class FragmentLabel {
  Strict,  ///< every facet that has not failed at all three corners
  Damage   ///< only facets of which no corner has failed: the pieces one sees
};

/// The fragment of every tet, numbered by the lowest tet it holds.
std::vector<Index> fragment_labels(const Topology& topology, const CrackState& cracks, FragmentLabel label);
/// Number of different labels.
Index num_fragments(const std::vector<Index>& labels);

}  // namespace knap
