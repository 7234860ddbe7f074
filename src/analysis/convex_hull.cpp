#include "analysis/convex_hull.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
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

/// Volume [m3] between the triangles of a closed surface, by tets to its first vertex.
double enclosed_volume(const HullMesh& mesh) {
  const Vec3 apex = to_vec3(mesh.point(*mesh.vertices_begin()));
  double volume = 0.0;
  for (const auto face : mesh.faces()) {
    const auto a = mesh.halfedge(face);
    const auto b = mesh.next(a);
    const auto c = mesh.next(b);
    volume += tet_volume(apex, to_vec3(mesh.point(mesh.target(a))), to_vec3(mesh.point(mesh.target(b))),
                         to_vec3(mesh.point(mesh.target(c))));
  }
  return std::abs(volume);
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
