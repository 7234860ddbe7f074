#include "analysis/convex_hull.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <cmath>

#include "core/tet_mesh.hpp"

namespace knap {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using HullMesh = CGAL::Surface_mesh<Kernel::Point_3>;

Vec3 to_vec3(const Kernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }

using ExactVec3 = std::array<CGAL::Exact_rational, 3>;

ExactVec3 exact_difference(const Kernel::Point_3& a, const Kernel::Point_3& b) {
  ExactVec3 difference;
  for (int k = 0; k < 3; ++k)
    difference[static_cast<std::size_t>(k)] = CGAL::Exact_rational(a[k]) - CGAL::Exact_rational(b[k]);
  return difference;
}

CGAL::Exact_rational determinant(const ExactVec3& a, const ExactVec3& b, const ExactVec3& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// Volume [m3] between the triangles of a closed surface, by tets to its first vertex; summed exactly, because the
/// order of faces and vertices follows the addresses of memory, and flat parts have triangles by the order of the
/// points.
double enclosed_volume(const HullMesh& mesh) {
  const Kernel::Point_3& apex = mesh.point(*mesh.vertices_begin());
  std::vector<ExactVec3> arm(mesh.number_of_vertices());
  for (const auto vertex : mesh.vertices()) arm[vertex.idx()] = exact_difference(mesh.point(vertex), apex);
  CGAL::Exact_rational sum = 0;
  for (const auto face : mesh.faces()) {
    const auto a = mesh.halfedge(face);
    const auto b = mesh.next(a);
    const auto c = mesh.next(b);
    sum += determinant(arm[mesh.target(a).idx()], arm[mesh.target(b).idx()], arm[mesh.target(c).idx()]);
  }
  return std::abs(CGAL::to_double(sum)) / 6.0;
}

ConvexHull flat_hull(std::span<const Vec3> points) { return {{points.begin(), points.end()}, 0.0}; }

}  // namespace

ConvexHull convex_hull(std::span<const Vec3> points) {
  const bool finite = std::all_of(points.begin(), points.end(), [](const Vec3& p) { return p.allFinite(); });
  if (points.size() < 4 || !finite) return flat_hull(points);
  if (points.size() == 4) {
    return {{points.begin(), points.end()}, std::abs(tet_volume(points[0], points[1], points[2], points[3]))};
  }
  std::vector<Kernel::Point_3> input;
  input.reserve(points.size());
  for (const Vec3& p : points) input.emplace_back(p.x(), p.y(), p.z());
  HullMesh mesh;
  CGAL::convex_hull_3(input.begin(), input.end(), mesh);  // isolated points or an open sheet for a flat set
  if (mesh.number_of_faces() < 4 || !CGAL::is_closed(mesh)) return flat_hull(points);
  ConvexHull hull;
  hull.points.reserve(mesh.number_of_vertices());
  for (const auto vertex : mesh.vertices()) hull.points.push_back(to_vec3(mesh.point(vertex)));
  hull.volume = enclosed_volume(mesh);
  return hull;
}

}  // namespace knap
