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

std::vector<ContactPoint> contact_points(const Topology& topology, std::span<const std::uint8_t> free_faces,
                                         std::span<const Index> fragment_of_tet) {
  std::vector<Index> fragment_of_node(at(topology.num_nodes()), none);
  std::vector<ContactPoint> faces;
  for (Index t = 0; t < topology.num_tets(); ++t)
    for (std::size_t i = 0; i < 4; ++i) {
      if ((free_faces[at(t)] >> i & 1u) == 0) continue;
      ContactPoint face;
      for (std::size_t k = 0; k < 3; ++k) {
        face.nodes[k] = topology.tet_nodes[at(t)][at(facet_of_corner[i][k])];
        fragment_of_node[at(face.nodes[k])] = fragment_of_tet[at(t)];
      }
      face.fragment = fragment_of_tet[at(t)];
      face.key = -(4 * static_cast<std::int64_t>(t) + static_cast<std::int64_t>(i) + 1);
      faces.push_back(face);
    }
  std::vector<ContactPoint> points;
  for (Index node = 0; node < topology.num_nodes(); ++node)
    if (fragment_of_node[at(node)] != none) points.push_back({{node, none, none}, node, fragment_of_node[at(node)]});
  points.insert(points.end(), faces.begin(), faces.end());
  return points;
}

}  // namespace knap
