#pragma once
#include <vector>

#include "core/topology.hpp"

namespace knap {

/// Per tet a bit for each free face: outer surface, or a facet handed over to the general contact.
std::vector<std::uint8_t> free_faces(const Topology& topology);

}  // namespace knap
