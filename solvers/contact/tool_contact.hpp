#pragma once
#include <span>

#include "contact/tool.hpp"
#include "core/nodal_state.hpp"

namespace knap {

/// The step that tools act in.
struct ToolStep {
  double dt = 0.0;         ///< [s]
  std::int64_t step = 0;   ///< its number
  double tolerance = 0.0;  ///< what began the step deeper than this in a tool stays as deep: it is not thrown out [m]
  std::span<const Index> body_of_node{};  ///< as in RigidBodies: nodes of rigid bodies are left alone
};

/// Exact unilateral contact of every node with every tool: where the step would end inside a tool, at tool.next, the
/// impulse that makes it end on the surface (the gap linearised where the step would end), with Coulomb friction
/// against the surface's velocity. Nodes on two tools are solved for both. A guided tool and its nodes are solved
/// together: they end the step in touch, and momentum along the guide is kept to round-off. Must be the last impulses
/// of a step: the losses are taken at the final velocities. Returns the nodes touched, ascending, each once.
std::vector<Index> apply_tools(std::span<Tool> tools, NodalState& nodes, const ToolStep& step);

}  // namespace knap
