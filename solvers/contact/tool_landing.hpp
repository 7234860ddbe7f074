#pragma once
// Which nodes a tool stops, and how.
#include <optional>
#include <span>

#include "contact/tool_contact.hpp"

namespace knap {

inline constexpr Index nodes_per_landing_block = 2048;

/// How a node goes towards a tool in a step.
struct NodeApproach {
  Vec3 end = Vec3::Zero();      ///< of the step as it would be [m]
  Vec3 normal = Vec3::Zero();   ///< of the tool's surface near it
  double stop = 0.0;            ///< normal velocity it lacks to stay out [m/s]; negative = stays out by itself
  Vec3 sliding = Vec3::Zero();  ///< along the surface, over it [m/s]
};

/// A node that a tool stops.
struct NodeLanding {
  Index node = none;
  Index tool = none;
  Vec3 end = Vec3::Zero();      ///< where the step would have ended [m]
  Vec3 push = Vec3::Zero();     ///< normal impulse [N s]
  Vec3 drag = Vec3::Zero();     ///< of friction [N s]
  Vec3 v_free = Vec3::Zero();   ///< before [m/s]
  Vec3 v_after = Vec3::Zero();  ///< with both impulses [m/s]
};

/// By block of nodes, ascending by node and tool.
using ToolLandings = std::vector<std::vector<NodeLanding>>;

NodeApproach approach_of(const Tool& tool, const NodalState& nodes, Index node, const ToolStep& step);

/// The landing of a node on a tool, if its step would end inside. Changes nothing.
std::optional<NodeLanding> find_landing(const Tool& tool, const NodalState& nodes, Index node, const ToolStep& step);

/// The landings of all nodes, each on each tool as if the others were not there. A block of nodes that ends the step
/// outside a tool's bounding box costs that tool nothing.
ToolLandings find_landings(std::span<const Tool> tools, const NodalState& nodes, const ToolStep& step);

}  // namespace knap
