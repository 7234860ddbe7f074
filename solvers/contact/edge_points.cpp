#include "contact/edge_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace knap {
namespace {

constexpr Index points_per_leaf = 8;
const double cos_of_sharp = std::cos(10.0 / 180.0 * std::numbers::pi);

void add_ring(std::vector<EdgePoint>& points, double radius, double z, double axial, double spacing) {
  const auto count = static_cast<int>(std::max(8.0, std::ceil(2.0 * std::numbers::pi * radius / spacing)));
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / count;
    const Vec3 radial(std::cos(angle), std::sin(angle), 0.0);
    points.push_back({radius * radial + z * Vec3::UnitZ(), (radial + axial * Vec3::UnitZ()).normalized()});
  }
}

// The direction in which the edge opposite corner i of a triangle can cut, each edge once; zero if it cannot.
Vec3 cutting_direction(const TriangleSurface& surface, Index triangle, std::size_t i) {
  const Index neighbour = surface.neighbours[at(triangle)][i];
  const Triangle& corners = surface.triangles[at(triangle)];
  const Vec3& from = surface.vertices[at(corners[(i + 1) % 3])];
  const Vec3& normal = surface.face_normals[at(triangle)];
  if (neighbour == none) return (surface.vertices[at(corners[(i + 2) % 3])] - from).cross(normal).normalized();
  if (neighbour < triangle || normal.dot(surface.face_normals[at(neighbour)]) > cos_of_sharp) return Vec3::Zero();
  double height = 0.0;  // of the neighbour's far corner: below the plane where the edge sticks out
  for (const Index vertex : surface.triangles[at(neighbour)]) {
    const double here = normal.dot(surface.vertices[at(vertex)] - from);
    if (std::abs(here) > std::abs(height)) height = here;
  }
  if (height > 0.0 && surface.closed) return Vec3::Zero();
  return (height > 0.0 ? -1.0 : 1.0) * surface.edge_normals[at(triangle)][i].normalized();
}

double squared_distance(const PointTree::Box& a, const ShapeBox& b) {
  return (a.low - b.high).cwiseMax(b.low - a.high).cwiseMax(0.0).squaredNorm();
}

struct PointTreeBuilder {
  PointTree& tree;

  void build(Index first, Index count) {
    const std::size_t place = tree.boxes.size();
    PointTree::Box box{tree.points[at(first)].place, tree.points[at(first)].place, first, 0, none};
    for (Index i = first; i < first + count; ++i) {
      box.low = box.low.cwiseMin(tree.points[at(i)].place);
      box.high = box.high.cwiseMax(tree.points[at(i)].place);
    }
    if (count <= points_per_leaf) box.count = count;
    tree.boxes.push_back(box);
    if (count <= points_per_leaf) return;
    Eigen::Index axis = 0;
    (box.high - box.low).maxCoeff(&axis);
    const auto begin = tree.points.begin() + first;
    std::stable_sort(begin, begin + count,
                     [axis](const EdgePoint& a, const EdgePoint& b) { return a.place[axis] < b.place[axis]; });
    build(first, count / 2);
    tree.boxes[place].second = to_index(tree.boxes.size());
    build(first + count / 2, count - count / 2);
  }
};

}  // namespace

std::vector<EdgePoint> edge_points(const HalfSpace&, double) { return {}; }

std::vector<EdgePoint> edge_points(const DiscPlaten& shape, double spacing) {
  std::vector<EdgePoint> points;
  add_ring(points, shape.radius, 0.0, 1.0, spacing);
  add_ring(points, shape.radius, -shape.thickness, -1.0, spacing);
  return points;
}

std::vector<EdgePoint> edge_points(const BallTool&, double) { return {}; }

std::vector<EdgePoint> edge_points(const CylinderTool& shape, double spacing) {
  std::vector<EdgePoint> points;
  add_ring(points, shape.radius, 0.5 * shape.length, 1.0, spacing);
  add_ring(points, shape.radius, -0.5 * shape.length, -1.0, spacing);
  return points;
}

std::vector<EdgePoint> edge_points(const SurfaceTool& shape, double spacing) {
  const TriangleSurface& surface = shape.surface;
  std::vector<EdgePoint> points;
  std::vector<Vec3> at_corner(surface.vertices.size(), Vec3::Zero());
  std::vector<char> is_corner(surface.vertices.size(), 0);
  for (Index t = 0; t < to_index(surface.triangles.size()); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 outward = cutting_direction(surface, t, i);
      if (outward.isZero(0.0)) continue;
      const Index from = surface.triangles[at(t)][(i + 1) % 3], to = surface.triangles[at(t)][(i + 2) % 3];
      for (const Index vertex : {from, to}) {
        is_corner[at(vertex)] = 1;
        at_corner[at(vertex)] += outward;
      }
      const Vec3 &a = surface.vertices[at(from)], &b = surface.vertices[at(to)];
      const double count = std::ceil((b - a).norm() / spacing);
      for (double k = 1.0; k < count; ++k) points.push_back({a + k / count * (b - a), outward});
    }
  for (std::size_t i = 0; i < is_corner.size(); ++i)
    if (is_corner[i]) points.push_back({surface.vertices[i], at_corner[i].stableNormalized()});
  return points;
}

PointTree make_point_tree(std::vector<EdgePoint> points) {
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
      const Vec3& p = tree.points[at(i)].place;
      if ((p.array() >= box.low.array()).all() && (p.array() <= box.high.array()).all()) found.push_back(i);
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace knap
