#include "contact/tool_edges.hpp"

#include <algorithm>

#include "contact/free_faces.hpp"
#include "core/parallel.hpp"

namespace knap {
namespace {

constexpr Index tets_per_block = 512;
// Of the distance to an edge, what the way towards it may use up until the next look; the rest is for round-off.
constexpr double part_of_gap = 0.999;

double radius_about_origin(const PointTree& tree) {
  double radius = 0.0;
  for (const Vec3& point : tree.points) radius = std::max(radius, point.norm());
  return radius;
}

// How much nearer nodes and tool may have come in the last drift.
double last_way(const Tool& tool, double radius, const NodalState& nodes, double dt) {
  const Index block_size = 2048;
  std::vector<double> fastest(at(num_blocks(nodes.size(), block_size)), 0.0);
  parallel_blocks(to_index(fastest.size()), [&](Index block) {
    const Vec4 frame = padded(tool.state.velocity_before);
    const Index end = std::min(nodes.size(), (block + 1) * block_size);
    for (Index i = block * block_size; i < end; ++i)
      fastest[at(block)] = std::max(fastest[at(block)], (nodes.v_before[at(i)] - frame).squaredNorm());
  });
  const double largest = fastest.empty() ? 0.0 : *std::max_element(fastest.begin(), fastest.end());
  return dt * (std::sqrt(largest) + radius * tool.state.spin_before.norm());
}

using Corners = std::array<Vec3, 4>;

/// A tet seen from a tool.
struct TetAtTool {
  Corners corner;
  std::array<Vec3, 4> gradient;  // of the barycentric coordinates [1/m]
  bool flat = true;

  TetAtTool(const Tool& tool, const TetCorners& nodes, const NodalState& state) {
    for (std::size_t i = 0; i < 4; ++i)
      corner[i] = tool.state.orientation.conjugate() * (xyz(state.x[at(nodes[i])]) - tool.state.position);
  }
  ShapeBox box() const {
    ShapeBox result{corner[0], corner[0]};
    for (const Vec3& x : corner) {
      result.low = result.low.cwiseMin(x);
      result.high = result.high.cwiseMax(x);
    }
    return result;
  }
  void find_gradients() {
    const Vec3 a = corner[1] - corner[0], b = corner[2] - corner[0], c = corner[3] - corner[0];
    const double volume = a.cross(b).dot(c);
    if (!(volume > 0.0)) return;
    flat = false;
    gradient[1] = b.cross(c) / volume;
    gradient[2] = c.cross(a) / volume;
    gradient[3] = a.cross(b) / volume;
    gradient[0] = -(gradient[1] + gradient[2] + gradient[3]);
  }
  std::array<double, 4> coordinates(const Vec3& point) const {
    std::array<double, 4> lambda;
    for (std::size_t i = 1; i < 4; ++i) lambda[i] = gradient[i].dot(point - corner[0]);
    lambda[0] = 1.0 - lambda[1] - lambda[2] - lambda[3];
    return lambda;
  }
};

// The free face that a point inside is nearest to; every tet here has one.
std::size_t nearest_free_face(const TetAtTool& tet, const std::array<double, 4>& lambda, unsigned faces) {
  std::size_t nearest = 4;
  const auto depth = [&](std::size_t i) { return lambda[i] / tet.gradient[i].norm(); };
  for (std::size_t i = 0; i < 4; ++i)
    if ((faces >> i & 1u) != 0 && (nearest == 4 || depth(i) < depth(nearest))) nearest = i;
  return nearest;
}

void add_touches(std::vector<EdgeTouch>& touches, const Tool& tool, Index number, const PointTree& tree,
                 const TetCorners& nodes, unsigned faces, TetAtTool& tet) {
  tet.find_gradients();
  if (tet.flat) return;
  for (const Index point : points_in(tree, tet.box())) {
    const Vec3& local = tree.points[at(point)];
    const auto lambda = tet.coordinates(local);
    if (*std::min_element(lambda.begin(), lambda.end()) < 0.0) continue;
    const std::size_t face = nearest_free_face(tet, lambda, faces);
    const double on_face = 1.0 - lambda[face];
    if (!(on_face > 0.0)) continue;
    EdgeTouch touch;
    touch.tool = number;
    touch.place = tool.state.position + tool.state.orientation * local;
    touch.normal = tool.state.orientation * (-tet.gradient[face].normalized());
    for (std::size_t k = 0; k < 3; ++k) {
      const auto corner = static_cast<std::size_t>(facet_of_corner[face][k]);
      touch.nodes[k] = nodes[corner];
      touch.weights[k] = lambda[corner] / on_face;
    }
    touches.push_back(touch);
  }
}

bool is_rigid(const TetCorners& nodes, const ToolStep& step) {
  return at(nodes[0]) < step.body_of_node.size() && step.body_of_node[at(nodes[0])] != none;
}

// Of one tool, by tet.
void find_touches(EdgeWatch& watch, const Tool& tool, Index number, const Topology& topology, const NodalState& nodes,
                  const ToolStep& step, std::vector<EdgeTouch>& touches) {
  const PointTree& tree = watch.points_of_tool[at(number)];
  const double travel = watch.travel[at(number)];
  const Index count = to_index(watch.tets.size());
  std::vector<std::vector<EdgeTouch>> found(at(num_blocks(count, tets_per_block)));
  parallel_blocks(to_index(found.size()), [&](Index block) {
    const Index end = std::min(count, (block + 1) * tets_per_block);
    for (Index i = block * tets_per_block; i < end; ++i) {
      double& due = watch.due[at(number)][at(i)];
      if (due > travel) continue;
      const TetCorners& corners = topology.tet_nodes[at(watch.tets[at(i)])];
      TetAtTool tet(tool, corners, nodes);
      const double gap = distance_to(tree, tet.box());
      due = travel + part_of_gap * gap;
      if (gap > 0.0 || is_rigid(corners, step)) continue;
      add_touches(found[at(block)], tool, number, tree, corners, watch.faces[at(i)], tet);
    }
  });
  for (const auto& part : found) touches.insert(touches.end(), part.begin(), part.end());
}

}  // namespace

EdgeWatch make_edge_watch(std::span<const Tool> tools, double spacing) {
  EdgeWatch watch;
  for (const Tool& tool : tools)
    watch.points_of_tool.push_back(
        make_point_tree(std::visit([&](const auto& shape) { return edge_points(shape, spacing); }, tool.shape)));
  watch.travel.assign(tools.size(), 0.0);
  watch.due.resize(tools.size());
  return watch;
}

void watch_free_faces(EdgeWatch& watch, const Topology& topology) {
  const auto has_points = [](const PointTree& tree) { return !tree.points.empty(); };
  if (std::none_of(watch.points_of_tool.begin(), watch.points_of_tool.end(), has_points)) return;
  const auto all = free_faces(topology);
  std::vector<Index> tets;
  std::vector<std::uint8_t> faces;
  for (Index tet = 0; tet < to_index(all.size()); ++tet) {
    if (all[at(tet)] == 0) continue;
    tets.push_back(tet);
    faces.push_back(all[at(tet)]);
  }
  if (tets == watch.tets && faces == watch.faces) return;
  watch.tets = std::move(tets);
  watch.faces = std::move(faces);
  for (std::size_t k = 0; k < watch.due.size(); ++k) watch.due[k].assign(watch.tets.size(), watch.travel[k]);
}

std::vector<EdgeTouch> find_edge_touches(EdgeWatch& watch, std::span<const Tool> tools, const Topology& topology,
                                         const NodalState& nodes, const ToolStep& step) {
  std::vector<EdgeTouch> touches;
  for (std::size_t k = 0; k < tools.size(); ++k) {
    const PointTree& tree = watch.points_of_tool[k];
    if (tree.points.empty()) continue;
    watch.travel[k] += last_way(tools[k], radius_about_origin(tree), nodes, step.dt);
    find_touches(watch, tools[k], to_index(k), topology, nodes, step, touches);
  }
  return touches;
}

}  // namespace knap
