#include "contact/edge_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace knap {
namespace {

constexpr Index points_per_leaf = 8;
const double cos_of_sharp = std::cos(10.0 / 180.0 * std::numbers::pi);

void add_ring(std::vector<Vec3>& points, double radius, double z, double spacing) {
  const auto count = static_cast<int>(std::max(8.0, std::ceil(2.0 * std::numbers::pi * radius / spacing)));
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / count;
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
  }
}

// Whether the edge opposite corner i of a triangle can cut; each edge once.
bool is_sharp(const TriangleSurface& surface, Index triangle, std::size_t i) {
  const Index neighbour = surface.neighbours[at(triangle)][i];
  if (neighbour == none) return true;
  if (neighbour < triangle) return false;
  const Vec3& normal = surface.face_normals[at(triangle)];
  if (normal.dot(surface.face_normals[at(neighbour)]) > cos_of_sharp) return false;
  if (!surface.closed) return true;
  const Vec3& on_edge = surface.vertices[at(surface.triangles[at(triangle)][(i + 1) % 3])];
  double beyond = 0.0;  // of the neighbour's far corner: below the plane where the edge sticks out
  for (const Index vertex : surface.triangles[at(neighbour)])
    beyond = std::min(beyond, normal.dot(surface.vertices[at(vertex)] - on_edge));
  return beyond < 0.0;
}

double squared_distance(const PointTree::Box& a, const ShapeBox& b) {
  return (a.low - b.high).cwiseMax(b.low - a.high).cwiseMax(0.0).squaredNorm();
}

struct PointTreeBuilder {
  PointTree& tree;

  void build(Index first, Index count) {
    const std::size_t place = tree.boxes.size();
    PointTree::Box box{tree.points[at(first)], tree.points[at(first)], first, 0, none};
    for (Index i = first; i < first + count; ++i) {
      box.low = box.low.cwiseMin(tree.points[at(i)]);
      box.high = box.high.cwiseMax(tree.points[at(i)]);
    }
    if (count <= points_per_leaf) box.count = count;
    tree.boxes.push_back(box);
    if (count <= points_per_leaf) return;
    Eigen::Index axis = 0;
    (box.high - box.low).maxCoeff(&axis);
    const auto begin = tree.points.begin() + first;
    std::stable_sort(begin, begin + count, [axis](const Vec3& a, const Vec3& b) { return a[axis] < b[axis]; });
    build(first, count / 2);
    tree.boxes[place].second = to_index(tree.boxes.size());
    build(first + count / 2, count - count / 2);
  }
};

}  // namespace

std::vector<Vec3> edge_points(const HalfSpace&, double) { return {}; }

std::vector<Vec3> edge_points(const DiscPlaten& shape, double spacing) {
  std::vector<Vec3> points;
  add_ring(points, shape.radius, 0.0, spacing);
  add_ring(points, shape.radius, -shape.thickness, spacing);
  return points;
}

std::vector<Vec3> edge_points(const BallTool&, double) { return {}; }

std::vector<Vec3> edge_points(const CylinderTool& shape, double spacing) {
  std::vector<Vec3> points;
  add_ring(points, shape.radius, 0.5 * shape.length, spacing);
  add_ring(points, shape.radius, -0.5 * shape.length, spacing);
  return points;
}

std::vector<Vec3> edge_points(const SurfaceTool& shape, double spacing) {
  const TriangleSurface& surface = shape.surface;
  std::vector<Vec3> points;
  std::vector<char> is_corner(surface.vertices.size(), 0);
  for (Index t = 0; t < to_index(surface.triangles.size()); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      if (!is_sharp(surface, t, i)) continue;
      const Index from = surface.triangles[at(t)][(i + 1) % 3], to = surface.triangles[at(t)][(i + 2) % 3];
      is_corner[at(from)] = is_corner[at(to)] = 1;
      const Vec3 &a = surface.vertices[at(from)], &b = surface.vertices[at(to)];
      const double count = std::ceil((b - a).norm() / spacing);
      for (double k = 1.0; k < count; ++k) points.push_back(a + k / count * (b - a));
    }
  for (std::size_t i = 0; i < is_corner.size(); ++i)
    if (is_corner[i]) points.push_back(surface.vertices[i]);
  return points;
}

PointTree make_point_tree(std::vector<Vec3> points) {
  PointTree tree{std::move(points), {}};
  if (!tree.points.empty()) PointTreeBuilder{tree}.build(0, to_index(tree.points.size()));
  return tree;
}

double distance_to(const PointTree& tree, const ShapeBox& box) {
  double least = std::numeric_limits<double>::infinity();
  std::vector<Index> waiting;
  if (!tree.boxes.empty()) waiting.push_back(0);
  while (!waiting.empty()) {
    const Index place = waiting.back();
    waiting.pop_back();
    const PointTree::Box& here = tree.boxes[at(place)];
    const double distance = squared_distance(here, box);
    if (distance >= least) continue;
    if (here.count > 0)
      least = distance;
    else
      waiting.insert(waiting.end(), {place + 1, here.second});
  }
  return std::sqrt(least);
}

std::vector<Index> points_in(const PointTree& tree, const ShapeBox& box) {
  std::vector<Index> found, waiting;
  if (!tree.boxes.empty()) waiting.push_back(0);
  while (!waiting.empty()) {
    const Index place = waiting.back();
    waiting.pop_back();
    const PointTree::Box& here = tree.boxes[at(place)];
    if (squared_distance(here, box) > 0.0) continue;
    if (here.count == 0) waiting.insert(waiting.end(), {place + 1, here.second});
    for (Index i = here.first; i < here.first + here.count; ++i) {
      const Vec3& p = tree.points[at(i)];
      if ((p.array() >= box.low.array()).all() && (p.array() <= box.high.array()).all()) found.push_back(i);
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace knap
