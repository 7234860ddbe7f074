#include "contact/tool_landing.hpp"

#include <algorithm>

#include "core/parallel.hpp"

namespace knap {
namespace {

/// The world seen from a tool.
struct ToolFrame {
  Vec3 position;
  Mat3 rotation;  // tool to world

  explicit ToolFrame(const ToolPose& pose) : position(pose.position), rotation(pose.orientation.toRotationMatrix()) {}
  Vec3 local(const Vec3& point) const { return rotation.transpose() * (point - position); }
};

/// A tool of one kind, where the step begins and where it ends.
template <class Shape>
struct ToolInStep {
  const Tool& tool;
  const Shape& shape;
  const ToolStep& step;
  ToolFrame begin{tool.state.pose()}, end{tool.next};

  SurfaceDistance distance_after(const Vec3& point) const { return surface_distance(shape, end.local(point)); }

  bool is_rigid(Index node) const { return at(node) < step.body_of_node.size() && step.body_of_node[at(node)] != none; }

  // A point whose step would end at `after`, seen from there; it may stay as deep as it was.
  NodeApproach approach(const Vec3& x, const Vec3& v, const Vec3& after, const SurfaceDistance& distance) const {
    const double before = surface_distance(shape, begin.local(x)).gap;
    const double allowed = before < -step.tolerance ? before : 0.0;
    const Vec3 normal = end.rotation * distance.normal;
    const Vec3 over = v - (tool.state.velocity + tool.state.spin.cross(after - tool.next.position));
    return {after, normal, (allowed - distance.gap) / step.dt, over - normal.dot(over) * normal};
  }

  std::optional<NodeLanding> landing(const NodalState& nodes, Index node) const {
    const Vec3 x = xyz(nodes.x[at(node)]), v = xyz(nodes.v[at(node)]);
    const Vec3 after = x + step.dt * v;
    const SurfaceDistance distance = distance_after(after);
    if (!(distance.gap < 0.0) || is_rigid(node)) return std::nullopt;
    const NodeApproach a = approach(x, v, after, distance);
    if (!(a.stop > 0.0)) return std::nullopt;
    const double speed = a.sliding.norm();
    const double slowdown = speed > 0.0 ? std::min(1.0, tool.friction * a.stop / speed) : 0.0;
    const double mass = nodes.mass[at(node)];
    return NodeLanding{.node = node,
                       .end = after,
                       .push = mass * a.stop * a.normal,
                       .drag = -mass * slowdown * a.sliding,
                       .v_free = v,
                       .v_after = v + (a.stop * a.normal - slowdown * a.sliding)};
  }

  // Whether any point of a box could be inside. Widened by more than round-off.
  bool may_reach(const ShapeBox& box) const {
    const ShapeBox own = bounding_box(shape);
    const Vec3 centre = end.local(0.5 * (box.low + box.high));
    const Vec3 half = end.rotation.transpose().cwiseAbs() * (0.5 * (box.high - box.low));
    const double round_off = 1e-12 * (centre.norm() + half.norm() + end.position.norm());
    const Vec3 reach = half + Vec3::Constant(round_off);
    return ((centre - reach).array() <= own.high.array()).all() && ((centre + reach).array() >= own.low.array()).all();
  }
};

// Around where the nodes [begin, end) would be after the step.
ShapeBox box_after(const NodalState& nodes, Index begin, Index end, double dt) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Vec4 low = Vec4::Constant(infinity), high = Vec4::Constant(-infinity);
  for (Index i = begin; i < end; ++i) {
    const Vec4 after = nodes.x[at(i)] + dt * nodes.v[at(i)];
    low = low.cwiseMin(after);
    high = high.cwiseMax(after);
  }
  return {low.head<3>(), high.head<3>()};
}

bool by_node(const NodeLanding& a, const NodeLanding& b) { return a.node < b.node; }

template <class Action>
auto with_shape(const Tool& tool, const ToolStep& step, Action&& action) {
  return std::visit(
      [&]<class Shape>(const Shape& shape) {
        return action(ToolInStep<Shape>{tool, shape, step});
      },
      tool.shape);
}

}  // namespace

NodeApproach approach_of(const Tool& tool, const NodalState& nodes, Index node, const ToolStep& step) {
  return with_shape(tool, step, [&](const auto& in_step) {
    const Vec3 x = xyz(nodes.x[at(node)]), v = xyz(nodes.v[at(node)]);
    const Vec3 after = x + step.dt * v;
    return in_step.approach(x, v, after, in_step.distance_after(after));
  });
}

std::optional<NodeLanding> find_landing(const Tool& tool, const NodalState& nodes, Index node, const ToolStep& step) {
  return with_shape(tool, step, [&](const auto& in_step) { return in_step.landing(nodes, node); });
}

ToolLandings find_landings(std::span<const Tool> tools, const NodalState& nodes, const ToolStep& step) {
  ToolLandings landings(at(num_blocks(nodes.size(), nodes_per_landing_block)));
  parallel_blocks(to_index(landings.size()), [&](Index block) {
    const Index begin = block * nodes_per_landing_block;
    const Index end = std::min(nodes.size(), begin + nodes_per_landing_block);
    const ShapeBox box = box_after(nodes, begin, end, step.dt);
    auto& found = landings[at(block)];
    for (std::size_t k = 0; k < tools.size(); ++k)
      with_shape(tools[k], step, [&](const auto& in_step) {
        if (!in_step.may_reach(box)) return;
        for (Index i = begin; i < end; ++i)
          if (auto landing = in_step.landing(nodes, i)) {
            landing->tool = to_index(k);
            found.push_back(*landing);
          }
      });
    if (tools.size() > 1) std::stable_sort(found.begin(), found.end(), by_node);
  });
  return landings;
}

}  // namespace knap
