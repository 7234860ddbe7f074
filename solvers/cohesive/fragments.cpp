#include "cohesive/fragments.hpp"

#include <algorithm>
#include <numeric>

namespace knap {
namespace {

Index root(std::vector<Index>& parent, Index i) {
  while (parent[at(i)] != i) {
    parent[at(i)] = parent[at(parent[at(i)])];
    i = parent[at(i)];
  }
  return i;
}

bool holds(const Topology& topology, const CrackState& cracks, Index facet, FragmentLabel label) {
  const FacetState state = topology.facet_state[at(facet)];
  if (state == FacetState::Bonded) return true;
  if (state != FacetState::Cohesive) return false;
  const auto& failed = cracks.faces[at(cracks.face_of_facet[at(facet)])].failed;
  const int count = failed[0] + failed[1] + failed[2];
  return label == FragmentLabel::Strict ? count < 3 : count == 0;
}

}  // namespace

std::vector<Index> fragment_labels(const Topology& topology, const CrackState& cracks, FragmentLabel label) {
  std::vector<Index> parent(at(topology.num_tets()));
  std::iota(parent.begin(), parent.end(), 0);
  for (Index facet = 0; facet < topology.num_facets(); ++facet) {
    if (!holds(topology, cracks, facet, label)) continue;
    const Index a = root(parent, topology.facet_tets[at(facet)][0]);
    const Index b = root(parent, topology.facet_tets[at(facet)][1]);
    parent[at(std::max(a, b))] = std::min(a, b);
  }
  std::vector<Index> number(parent.size(), none);
  Index next = 0;
  for (Index t = 0; t < to_index(parent.size()); ++t) {
    const Index r = root(parent, t);
    if (number[at(r)] == none) number[at(r)] = next++;
  }
  for (Index t = 0; t < to_index(parent.size()); ++t) parent[at(t)] = root(parent, t);
  for (Index& label_of_tet : parent) label_of_tet = number[at(label_of_tet)];
  return parent;
}

Index num_fragments(const std::vector<Index>& labels) {
  return labels.empty() ? 0 : *std::max_element(labels.begin(), labels.end()) + 1;
}

}  // namespace knap
