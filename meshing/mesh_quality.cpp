#include "meshing/mesh_quality.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace knap {
namespace {

using TetPoints = std::array<Vec3, 4>;

TetPoints points_of(const TetMesh& mesh, Index tet) {
  const auto& [a, b, c, d] = mesh.tets[at(tet)];
  const auto& v = mesh.vertices;
  return {v[at(a)], v[at(b)], v[at(c)], v[at(d)]};
}

// Outward area vectors (twice the area) of the facets of a positive tet.
TetPoints facet_normals(const TetPoints& p) {
  TetPoints normals;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& [a, b, c] = facet_of_corner[i];
    normals[i] = (p[at(b)] - p[at(a)]).cross(p[at(c)] - p[at(a)]);
  }
  return normals;
}

double smallest_dihedral(const TetPoints& normals) {
  double smallest = std::numbers::pi;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j)
      smallest = std::min(smallest, std::atan2(normals[i].cross(normals[j]).norm(), -normals[i].dot(normals[j])));
  return smallest;
}

void measure_edges(const TetMesh& mesh, MeshQuality& quality) {
  for (const TetCorners& tet : mesh.tets)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i + 1; j < 4; ++j) {
        const double length = (mesh.vertices[at(tet[i])] - mesh.vertices[at(tet[j])]).norm();
        quality.min_edge = std::min(quality.min_edge, length);
        quality.max_edge = std::max(quality.max_edge, length);
      }
  quality.mean_edge = mean_edge(mesh);
}

}  // namespace

double shape_quality(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const double sum = (b - a).squaredNorm() + (c - a).squaredNorm() + (d - a).squaredNorm() + (c - b).squaredNorm() +
                     (d - b).squaredNorm() + (d - c).squaredNorm();
  const double mean_square = sum / 6.0;
  return 6.0 * std::numbers::sqrt2 * tet_volume(a, b, c, d) / (mean_square * std::sqrt(mean_square));
}

double shape_quality(const TetMesh& mesh, Index tet) {
  const auto [a, b, c, d] = points_of(mesh, tet);
  return shape_quality(a, b, c, d);
}

MeshQuality measure_quality(const TetMesh& mesh) {
  MeshQuality quality;
  quality.num_tets = mesh.num_tets();
  quality.num_vertices = mesh.num_vertices();
  if (mesh.tets.empty()) return quality;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  quality.min_shape = quality.min_dihedral = quality.min_altitude = quality.min_edge = infinity;
  double shape_sum = 0.0;
  for (Index t = 0; t < mesh.num_tets(); ++t) {
    const TetPoints p = points_of(mesh, t);
    const TetPoints normals = facet_normals(p);
    const double shape = shape_quality(p[0], p[1], p[2], p[3]);
    shape_sum += shape;
    quality.min_shape = std::min(quality.min_shape, shape);
    quality.min_dihedral = std::min(quality.min_dihedral, smallest_dihedral(normals));
    for (const Vec3& normal : normals)
      quality.min_altitude = std::min(quality.min_altitude, 6.0 * tet_volume(mesh, t) / normal.norm());
  }
  quality.mean_shape = shape_sum / static_cast<double>(mesh.tets.size());
  quality.total_volume = volume(mesh);
  measure_edges(mesh, quality);
  return quality;
}

}  // namespace knap
