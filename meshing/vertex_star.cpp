#include "meshing/vertex_star.hpp"

#include <algorithm>
#include <limits>

#include "core/topology.hpp"
#include "meshing/mesh_quality.hpp"

namespace knap {

Csr tets_of_vertices(const TetMesh& mesh) {
  std::vector<Index> vertex_of_corner;
  vertex_of_corner.reserve(4 * mesh.tets.size());
  for (const TetCorners& tet : mesh.tets) vertex_of_corner.insert(vertex_of_corner.end(), tet.begin(), tet.end());
  Csr tets = make_csr(mesh.num_vertices(), vertex_of_corner);
  for (Index& item : tets.items) item /= 4;
  return tets;
}

std::vector<bool> surface_vertices(const TetMesh& mesh) {
  std::vector<bool> on_surface(mesh.vertices.size(), false);
  for (const Index corner : make_topology(mesh).outer_facets)
    for (const int k : facet_of_corner[at(corner & 3)]) on_surface[at(mesh.tets[at(corner >> 2)][at(k)])] = true;
  return on_surface;
}

double worst_shape(const TetMesh& mesh, std::span<const Index> tets) {
  double worst = std::numeric_limits<double>::infinity();
  for (const Index t : tets) worst = std::min(worst, shape_quality(mesh, t));
  return worst;
}

double mean_edge_at(const TetMesh& mesh, std::span<const Index> tets, Index vertex) {
  double sum = 0.0;
  for (const Index t : tets)
    for (const Index other : mesh.tets[at(t)]) sum += (mesh.vertices[at(other)] - mesh.vertices[at(vertex)]).norm();
  return tets.empty() ? 0.0 : sum / (3.0 * static_cast<double>(tets.size()));
}

}  // namespace knap
