#include "contact/triangle_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace knap {
namespace {

constexpr Index triangles_per_leaf = 4;

// Where on a triangle a point is: 0 to 2 at a corner, 3 to 5 on the edge opposite corner 0 to 2, 6 inside.
struct OnTriangle {
  Vec3 point;
  int feature;
};

OnTriangle nearest_on_edge(const Vec3& a, const Vec3& b, const Vec3& to, int corner_a, int corner_b) {
  const Vec3 along = b - a;
  const double length2 = along.squaredNorm(), way = along.dot(to - a);
  if (!(way > 0.0)) return {a, corner_a};
  if (!(way < length2)) return {b, corner_b};
  return {a + way / length2 * along, 3 + (3 - corner_a - corner_b)};
}

// The foot of the perpendicular if it is inside, else the nearest point of the three edges.
OnTriangle nearest_on_triangle(const std::array<Vec3, 3>& corner, const Vec3& to) {
  const Vec3 u = corner[1] - corner[0], v = corner[2] - corner[0], w = to - corner[0];
  const Vec3 normal = u.cross(v);
  const double area2 = normal.squaredNorm();
  const double at_1 = w.cross(v).dot(normal), at_2 = u.cross(w).dot(normal), at_0 = area2 - at_1 - at_2;
  if (area2 > 0.0 && at_0 > 0.0 && at_1 > 0.0 && at_2 > 0.0)
    return {corner[0] + at_1 / area2 * u + at_2 / area2 * v, 6};
  OnTriangle best{Vec3::Zero(), 6};
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [i, j] : {std::pair{0, 1}, std::pair{1, 2}, std::pair{2, 0}}) {
    const OnTriangle here =
        nearest_on_edge(corner[static_cast<std::size_t>(i)], corner[static_cast<std::size_t>(j)], to, i, j);
    const double distance = (here.point - to).squaredNorm();
    if (distance < least) least = distance, best = here;
  }
  return best;
}

std::array<Vec3, 3> corners(const TriangleSurface& surface, Index triangle) {
  const Triangle& t = surface.triangles[at(triangle)];
  return {surface.vertices[at(t[0])], surface.vertices[at(t[1])], surface.vertices[at(t[2])]};
}

void find_neighbours(TriangleSurface& surface) {
  std::map<std::pair<Index, Index>, std::pair<Index, std::size_t>> open;  // edge -> triangle and corner on its one side
  surface.neighbours.assign(surface.triangles.size(), {none, none, none});
  surface.closed = !surface.triangles.empty();
  for (Index t = 0; t < to_index(surface.triangles.size()); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = surface.triangles[at(t)][(i + 1) % 3], b = surface.triangles[at(t)][(i + 2) % 3];
      const auto [other, is_new] = open.try_emplace(std::minmax(a, b), t, i);
      if (is_new) continue;
      surface.neighbours[at(t)][i] = other->second.first;
      surface.neighbours[at(other->second.first)][other->second.second] = t;
    }
  for (const auto& neighbours : surface.neighbours)
    for (const Index neighbour : neighbours) surface.closed = surface.closed && neighbour != none;
}

double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

void find_normals(TriangleSurface& surface) {
  const Index count = to_index(surface.triangles.size());
  surface.face_normals.assign(at(count), Vec3::Zero());
  surface.vertex_normals.assign(surface.vertices.size(), Vec3::Zero());
  surface.edge_normals.assign(at(count), {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()});
  for (Index t = 0; t < count; ++t) {
    const auto corner = corners(surface, t);
    const Vec3 normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
    if (normal.norm() > 0.0) surface.face_normals[at(t)] = normal.normalized();
    for (std::size_t i = 0; i < 3; ++i)
      surface.vertex_normals[at(surface.triangles[at(t)][i])] +=
          angle_between(corner[(i + 1) % 3] - corner[i], corner[(i + 2) % 3] - corner[i]) * surface.face_normals[at(t)];
  }
  for (Index t = 0; t < count; ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const Index neighbour = surface.neighbours[at(t)][i];
      surface.edge_normals[at(t)][i] = surface.face_normals[at(t)];
      if (neighbour != none) surface.edge_normals[at(t)][i] += surface.face_normals[at(neighbour)];
    }
}

/// Builds the tree: boxes halved at the median of the triangles' centres along the longest side.
struct TreeBuilder {
  TriangleSurface& surface;
  std::vector<Vec3> centre;

  void build(Index first, Index count) {
    const std::size_t place = surface.tree.size();
    surface.tree.push_back(box(first, count));
    if (count <= triangles_per_leaf) {
      surface.tree[place].count = count;
      return;
    }
    Eigen::Index axis = 0;
    (surface.tree[place].high - surface.tree[place].low).maxCoeff(&axis);
    const auto begin = surface.order.begin() + first;
    std::sort(begin, begin + count,
              [&](Index a, Index b) { return std::pair(centre[at(a)][axis], a) < std::pair(centre[at(b)][axis], b); });
    build(first, count / 2);
    surface.tree[place].second = to_index(surface.tree.size());
    build(first + count / 2, count - count / 2);
  }

  TreeBox box(Index first, Index count) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    TreeBox result{Vec3::Constant(infinity), Vec3::Constant(-infinity), first, 0, none};
    for (Index i = first; i < first + count; ++i)
      for (const Vec3& corner : corners(surface, surface.order[at(i)])) {
        result.low = result.low.cwiseMin(corner);
        result.high = result.high.cwiseMax(corner);
      }
    return result;
  }
};

void build_tree(TriangleSurface& surface) {
  surface.tree.clear();
  surface.order.resize(surface.triangles.size());
  std::iota(surface.order.begin(), surface.order.end(), 0);
  TreeBuilder builder{surface, {}};
  for (Index t = 0; t < to_index(surface.triangles.size()); ++t) {
    const auto corner = corners(surface, t);
    builder.centre.push_back((corner[0] + corner[1] + corner[2]) / 3.0);
  }
  if (!surface.triangles.empty()) builder.build(0, to_index(surface.triangles.size()));
}

double squared_distance(const TreeBox& box, const Vec3& to) {
  return (box.low - to).cwiseMax(to - box.high).cwiseMax(0.0).squaredNorm();
}

Vec3 pseudo_normal(const TriangleSurface& surface, Index triangle, int feature) {
  if (feature == 6) return surface.face_normals[at(triangle)];
  if (feature >= 3) return surface.edge_normals[at(triangle)][static_cast<std::size_t>(feature - 3)];
  return surface.vertex_normals[at(surface.triangles[at(triangle)][static_cast<std::size_t>(feature)])];
}

}  // namespace

void complete_surface(TriangleSurface& surface) {
  find_neighbours(surface);
  find_normals(surface);
  build_tree(surface);
}

Rim rim_of(const TriangleSurface& surface) {
  Rim rim;
  for (Index t = 0; t < to_index(surface.neighbours.size()); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      if (surface.neighbours[at(t)][i] != none) continue;
      const auto corner = corners(surface, t);
      if (rim.num_edges == 0) rim.place = 0.5 * (corner[(i + 1) % 3] + corner[(i + 2) % 3]);
      ++rim.num_edges;
    }
  return rim;
}

SurfacePoint closest_point(const TriangleSurface& surface, const Vec3& to) {
  double least = std::numeric_limits<double>::infinity();
  OnTriangle best{Vec3::Zero(), 6};
  Index found = 0;
  std::array<Index, 128> waiting;  // one box a level at most, beside the two of the last
  std::size_t depth = 0;
  waiting[depth++] = 0;
  while (depth > 0) {
    const Index place = waiting[--depth];
    const TreeBox& box = surface.tree[at(place)];
    if (squared_distance(box, to) >= least) continue;
    if (box.count == 0) {
      const Index near = place + 1, far = box.second;
      const bool second_first =
          squared_distance(surface.tree[at(far)], to) < squared_distance(surface.tree[at(near)], to);
      waiting[depth++] = second_first ? near : far;
      waiting[depth++] = second_first ? far : near;
    }
    for (Index i = box.first; i < box.first + box.count; ++i) {
      const OnTriangle here = nearest_on_triangle(corners(surface, surface.order[at(i)]), to);
      const double distance = (here.point - to).squaredNorm();
      if (distance < least) least = distance, best = here, found = surface.order[at(i)];
    }
  }
  return {best.point, pseudo_normal(surface, found, best.feature), std::sqrt(least), best.feature == 6};
}

}  // namespace knap
