#include "contact/free_faces.hpp"

namespace knap {

std::vector<std::uint8_t> free_faces(const Topology& topology) {
  std::vector<std::uint8_t> bits(at(topology.num_tets()), 0);
  for (Index t = 0; t < topology.num_tets(); ++t)
    for (std::size_t i = 0; i < 4; ++i) {
      const Index facet = topology.tet_facets[at(t)][i];
      const bool is_free = facet == none || topology.facet_state[at(facet)] == FacetState::HandedOver;
      bits[at(t)] = static_cast<std::uint8_t>(bits[at(t)] | (is_free ? 1u << i : 0u));
    }
  return bits;
}

}  // namespace knap
