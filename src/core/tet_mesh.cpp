#include "core/tet_mesh.hpp"

#include <algorithm>

namespace knap {

TetMesh merged(std::span<const TetMesh> meshes) {
  TetMesh all;
  for (const TetMesh& mesh : meshes) {
    const Index first = all.num_vertices();
    all.vertices.insert(all.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (TetCorners tet : mesh.tets) {
      for (Index& vertex : tet) vertex += first;
      all.tets.push_back(tet);
    }
  }
  return all;
}

double tet_volume(const TetMesh& mesh, Index tet) {
  const auto& [a, b, c, d] = mesh.tets[at(tet)];
  const auto& v = mesh.vertices;
  return tet_volume(v[at(a)], v[at(b)], v[at(c)], v[at(d)]);
}

double volume(const TetMesh& mesh) {
  double sum = 0.0;
  for (Index t = 0; t < mesh.num_tets(); ++t) sum += tet_volume(mesh, t);
  return sum;
}

BoundingBox bounding_box(const TetMesh& mesh) {
  const Vec3& first = mesh.vertices[at(mesh.tets[0][0])];
  BoundingBox box{first, first};
  for (const TetCorners& tet : mesh.tets)
    for (const Index v : tet) {
      box.low = box.low.cwiseMin(mesh.vertices[at(v)]);
      box.high = box.high.cwiseMax(mesh.vertices[at(v)]);
    }
  return box;
}

double mean_edge(const TetMesh& mesh) {
  std::vector<std::pair<Index, Index>> edges;
  edges.reserve(mesh.tets.size() * 6);
  for (const auto& tet : mesh.tets)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i + 1; j < 4; ++j) edges.emplace_back(std::minmax(tet[i], tet[j]));
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  double sum = 0.0;
  for (const auto& [a, b] : edges) sum += (mesh.vertices[at(a)] - mesh.vertices[at(b)]).norm();
  return edges.empty() ? 0.0 : sum / static_cast<double>(edges.size());
}

}  // namespace knap
