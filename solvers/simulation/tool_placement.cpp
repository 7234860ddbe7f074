#include "simulation/tool_placement.hpp"

#include <fmt/format.h>

#include "core/errors.hpp"

namespace knap {
namespace {

// Depths up to this much of the mean edge are round-off of where the user put things.
constexpr double tolerance_over_edge = 1e-4;

void check_nodes(const Simulation& s, const Tool& tool) {
  double depth = 0.0;
  Vec3 away = Vec3::Zero();
  for (const Vec4& x : s.nodes.x) {
    const ToolProximity near = proximity(tool, xyz(x));
    if (-near.gap > depth) depth = -near.gap, away = near.normal;
  }
  if (depth <= tolerance_over_edge * s.reference.mean_edge) return;
  throw InputError(
      fmt::format("tool '{}': the particle starts {:.3g} mm inside it; move the particle that far along "
                  "({:.3g}, {:.3g}, {:.3g}), or the tool the other way",
                  tool.name, 1e3 * depth, away.x(), away.y(), away.z()));
}

bool contains(const TetCorners& nodes, const NodalState& state, const Vec3& point) {
  for (const auto& face : facet_of_corner) {
    const auto corner = [&](std::size_t k) -> Vec3 { return xyz(state.x[at(nodes[at(face[k])])]); };
    if (tet_volume(corner(0), corner(1), corner(2), point) > 0.0) return false;
  }
  return true;
}

void check_points(const Simulation& s, const Tool& tool) {
  const auto points = std::visit([](const auto& shape) { return points_inside(shape); }, tool.shape);
  const BoundingBox box = bounding_box({.vertices = s.reference.vertices, .tets = s.topology.tet_vertices});
  for (const Vec3& local : points) {
    const Vec3 point = tool.state.position + tool.state.orientation * local;
    if ((point.array() < box.low.array()).any() || (point.array() > box.high.array()).any()) continue;
    for (const TetCorners& tet : s.topology.tet_nodes)
      if (contains(tet, s.nodes, point))
        throw InputError(fmt::format("tool '{}': it starts inside the particle, at ({:.4g}, {:.4g}, {:.4g}) mm",
                                     tool.name, 1e3 * point.x(), 1e3 * point.y(), 1e3 * point.z()));
  }
}

}  // namespace

void check_tools_are_outside(const Simulation& s) {
  for (const Tool& tool : s.tools) {
    check_nodes(s, tool);
    check_points(s, tool);
  }
}

}  // namespace knap
