#pragma once
#include "contact/tool_contact.hpp"

namespace knap {

/// Impulses at the touches, with Coulomb friction, on nodes.v and on guided tools: a touch only pushes, and never more
/// than stops the approach. Fills in push and drag.
void push_edges(std::span<Tool> tools, NodalState& nodes, std::span<EdgeTouch> touches, double dt);

}  // namespace knap
