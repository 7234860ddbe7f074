#pragma once
// A tool's edge against the particle's faces. That nodes stay out of a tool is not enough: a sharp edge would cut
// between them. So points on the edges may not go deeper into a tet with a free face than they are: an impulse on the
// face's three nodes, at the level of velocities, so that it pushes nothing out and a depth of one step's way stays.
#include <span>

#include "contact/edge_points.hpp"
#include "contact/tool_contact.hpp"
#include "core/topology.hpp"

namespace knap {

/// Tets with a free face and when to look at each again. All of it follows from the state: nothing is persistent.
struct EdgeWatch {
  std::vector<Index> tets;
  std::vector<std::uint8_t> faces;        ///< of these tets, bit i = the face opposite corner i is free
  std::vector<PointTree> points_of_tool;  ///< in the tool's frame; empty = it has no edges
  std::vector<double> travel;             ///< by tool: no node has come nearer to its edges than by this [m]
  std::vector<std::vector<double>> due;   ///< by tool and tet: travel up to which they cannot touch [m]
};

/// For tools whose edges are to be looked at in steps not above `spacing` [m].
EdgeWatch make_edge_watch(std::span<const Tool> tools, double spacing);

/// To be called when faces have become free.
void watch_free_faces(EdgeWatch& watch, const Topology& topology);

/// Adds what may have moved in the step that ends here to the travels, and finds the points that are inside a tet now.
/// By tool, tet and point.
std::vector<EdgeTouch> find_edge_touches(EdgeWatch& watch, std::span<const Tool> tools, const Topology& topology,
                                         const NodalState& nodes, const ToolStep& step);

}  // namespace knap
