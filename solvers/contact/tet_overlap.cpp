#include "contact/tet_overlap.hpp"

#include <algorithm>
#include <cmath>

namespace knap {
namespace {

constexpr std::array<std::array<std::size_t, 2>, 6> edges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

/// A point by its four barycentric coordinates in the other tet and its position: cutting needs no products then.
using Corner = Eigen::Matrix<double, 8, 1>;  // coordinates, x, y, z, 0

Vec3 place(const Corner& corner) { return corner.segment<3>(4); }

/// A convex polygon; four planes cut at most four corners off a triangle.
struct Polygon {
  std::array<Corner, 8> corners;
  std::size_t count = 0;

  void add(const Corner& corner) { corners[count++] = corner; }
};

/// The corners of a tet as points of the other one.
using CornersInOther = std::array<Corner, 4>;

CornersInOther corners_in(const TetShape& other, const TetShape& owner) {
  CornersInOther corners;
  for (std::size_t c = 0; c < 4; ++c) {
    for (std::size_t i = 0; i < 4; ++i)
      corners[c][static_cast<Eigen::Index>(i)] = other.coordinate(i, owner.corners[c]);
    corners[c].segment<3>(4) = owner.corners[c];
    corners[c][7] = 0.0;
  }
  return corners;
}

// The part of the polygon where coordinate i is not negative (Sutherland & Hodgman 1974).
void clip(Polygon& polygon, Eigen::Index i) {
  bool all = true;
  for (std::size_t k = 0; k < polygon.count; ++k) all = all && polygon.corners[k][i] >= 0.0;
  if (all) return;
  Polygon rest;
  for (std::size_t k = 0; k < polygon.count; ++k) {
    const Corner& here = polygon.corners[k];
    const Corner& next = polygon.corners[k + 1 < polygon.count ? k + 1 : 0];
    if (here[i] >= 0.0) rest.add(here);
    if ((here[i] >= 0.0) == (next[i] >= 0.0) || rest.count == rest.corners.size()) continue;
    rest.add(here + here[i] / (here[i] - next[i]) * (next - here));
  }
  polygon = rest;
}

Polygon face_inside(const CornersInOther& corners, std::size_t face) {
  Polygon polygon;
  for (const int corner : facet_of_corner[face]) polygon.add(corners[at(corner)]);
  for (Eigen::Index i = 0; i < 4; ++i)
    if (polygon.corners[0][i] < 0.0 && polygon.corners[1][i] < 0.0 && polygon.corners[2][i] < 0.0) return {};
  for (Eigen::Index i = 0; i < 4 && polygon.count > 0; ++i) clip(polygon, i);
  return polygon;
}

/// All corners of a patch.
struct Corners {
  std::array<Vec3, 64> points;
  std::size_t count = 0;
};

// Adds the polygon's area vector, which points out of its tet, times sign.
void add_polygon(const Polygon& polygon, double sign, OverlapPatch& patch, Corners& corners) {
  if (polygon.count < 3) return;
  const Vec3 a = place(polygon.corners[0]);
  for (std::size_t k = 1; k + 1 < polygon.count; ++k) {
    const Vec3 b = place(polygon.corners[k]), c = place(polygon.corners[k + 1]);
    const Vec3 area = 0.5 * (b - a).cross(c - a);
    const double size = area.norm();
    patch.area += sign * 0.5 * area;
    patch.centre += size / 3.0 * (a + b + c);
    patch.size += size;
  }
  for (std::size_t k = 0; k < polygon.count; ++k) corners.points[corners.count++] = place(polygon.corners[k]);
}

template <class Measure>
Vec3 largest(const Corners& corners, Measure&& measure) {
  std::size_t best = 0;
  double most = -1.0;
  for (std::size_t k = 0; k < corners.count; ++k)
    if (const double value = measure(corners.points[k]); value > most) {
      most = value;
      best = k;
    }
  return corners.points[best];
}

// Three corners of the patch that lie far apart: what a body can rest on.
std::array<Vec3, 3> far_corners(const Corners& corners, const Vec3& centre) {
  const Vec3 a = largest(corners, [&](const Vec3& p) { return (p - centre).squaredNorm(); });
  const Vec3 b = largest(corners, [&](const Vec3& p) { return (p - a).squaredNorm(); });
  const Vec3 c = largest(corners, [&](const Vec3& p) { return (b - a).cross(p - a).squaredNorm(); });
  return {a, b, c};
}

// Distance between the projections of two tets on an axis, times its length; negative if they overlap.
double distance_along(const Vec3& axis, const TetShape& a, const TetShape& b) {
  double low_a = 1e300, high_a = -1e300, low_b = 1e300, high_b = -1e300;
  for (std::size_t i = 0; i < 4; ++i) {
    const double pa = axis.dot(a.corners[i] - a.corners[0]), pb = axis.dot(b.corners[i] - a.corners[0]);
    low_a = std::min(low_a, pa);
    high_a = std::max(high_a, pa);
    low_b = std::min(low_b, pb);
    high_b = std::max(high_b, pb);
  }
  return std::max(low_b - high_a, low_a - high_b);
}

// Distance of b's nearest corner beyond a's faces, the largest over the faces.
double beyond_faces(const TetShape& a, const TetShape& b) {
  double largest_gap = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    double most = -1e300;
    for (const Vec3& corner : b.corners) most = std::max(most, a.coordinate(i, corner));
    largest_gap = std::max(largest_gap, -most * a.height[i]);
  }
  return largest_gap;
}

}  // namespace

std::array<double, 4> TetShape::coordinates(const Vec3& p) const {
  std::array<double, 4> lambda{};
  for (std::size_t i = 1; i < 4; ++i) lambda[i] = coordinate(i, p);
  lambda[0] = 1.0 - lambda[1] - lambda[2] - lambda[3];
  return lambda;
}

std::array<double, 4> coordinates_in(const TetCorners& nodes, const Vec3& p, std::span<const Vec4> x) {
  const Vec3 origin = xyz(x[at(nodes[0])]);
  const Vec3 a = xyz(x[at(nodes[1])]) - origin, b = xyz(x[at(nodes[2])]) - origin, c = xyz(x[at(nodes[3])]) - origin;
  const Vec3 bc = b.cross(c), d = p - origin;
  const double determinant = a.dot(bc);
  const double inverse = 1.0 / determinant;
  if (!(determinant > 0.0) || !std::isfinite(inverse)) return {0.25, 0.25, 0.25, 0.25};
  const Vec3 da = d.cross(a);
  const double first = inverse * d.dot(bc), second = -inverse * c.dot(da), third = inverse * b.dot(da);
  return {1.0 - first - second - third, first, second, third};
}

TetShape make_tet_shape(const TetCorners& nodes, std::span<const Vec4> x) {
  TetShape shape;
  for (std::size_t i = 0; i < 4; ++i) shape.corners[i] = xyz(x[at(nodes[i])]);
  const Vec3 a = shape.corners[1] - shape.corners[0];
  const Vec3 b = shape.corners[2] - shape.corners[0];
  const Vec3 c = shape.corners[3] - shape.corners[0];
  const Vec3 bc = b.cross(c);
  const double determinant = a.dot(bc);
  shape.is_solid = determinant > 0.0 && std::isfinite(1.0 / determinant);
  if (!shape.is_solid) {
    shape.gradient.fill(Vec3::Zero());
    shape.height.fill(0.0);
    return shape;
  }
  const double inverse = 1.0 / determinant;
  shape.gradient[1] = inverse * bc;
  shape.gradient[2] = inverse * c.cross(a);
  shape.gradient[3] = inverse * a.cross(b);
  shape.gradient[0] = -(shape.gradient[1] + shape.gradient[2] + shape.gradient[3]);
  for (std::size_t i = 0; i < 4; ++i) {
    const double norm = shape.gradient[i].norm();
    shape.height[i] = norm > 0.0 ? 1.0 / norm : 0.0;
  }
  return shape;
}

double separation_by_faces(const TetShape& a, const TetShape& b) {
  return std::max(beyond_faces(a, b), beyond_faces(b, a));
}

double separation_by_edges(const TetShape& a, const TetShape& b) {
  double largest_gap = 0.0;
  for (const auto& [i, j] : edges)
    for (const auto& [k, l] : edges) {
      const Vec3 axis = (a.corners[j] - a.corners[i]).cross(b.corners[l] - b.corners[k]);
      const double distance = distance_along(axis, a, b);
      if (distance > 0.0) largest_gap = std::max(largest_gap, distance / axis.norm());
    }
  return largest_gap;
}

OverlapPatch overlap_patch(const TetShape& a, unsigned free_faces_of_a, const TetShape& b, unsigned free_faces_of_b,
                           bool needs_corners) {
  OverlapPatch patch;
  Corners corners;
  const CornersInOther a_in_b = corners_in(b, a), b_in_a = corners_in(a, b);
  for (std::size_t face = 0; face < 4; ++face) {
    if ((free_faces_of_a >> face & 1u) != 0) add_polygon(face_inside(a_in_b, face), 1.0, patch, corners);
    if ((free_faces_of_b >> face & 1u) != 0) add_polygon(face_inside(b_in_a, face), -1.0, patch, corners);
  }
  if (!(patch.size > 0.0)) return {};
  patch.centre /= patch.size;
  if (needs_corners) patch.corners = far_corners(corners, patch.centre);
  return patch;
}

}  // namespace knap
