#pragma once
#include "contact/contact_state.hpp"

namespace knap {

/// Per tet a bit for each free face: outer surface, or a facet handed over to the general contact.
std::vector<std::uint8_t> free_faces(const Topology& topology);

/// The nodes of free faces and the centres of those faces, nodes first, ascending.
std::vector<ContactPoint> contact_points(const Topology& topology, std::span<const std::uint8_t> free_faces,
                                         std::span<const Index> fragment_of_tet);

}  // namespace knap
