#include "core/topology.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "core/errors.hpp"

namespace knap {
namespace {

struct Face {
  std::array<Index, 3> sorted_vertices;
  Index corner;  // 4 * tet + opposite local corner
  bool operator<(const Face& other) const {
    return std::tie(sorted_vertices, corner) < std::tie(other.sorted_vertices, other.corner);
  }
};

std::vector<Face> sorted_faces(const TetMesh& mesh) {
  std::vector<Face> faces;
  faces.reserve(mesh.tets.size() * 4);
  for (Index t = 0; t < mesh.num_tets(); ++t)
    for (Index i = 0; i < 4; ++i) {
      Face face{{}, 4 * t + i};
      for (std::size_t k = 0; k < 3; ++k) face.sorted_vertices[k] = mesh.tets[at(t)][at(facet_of_corner[at(i)][k])];
      std::sort(face.sorted_vertices.begin(), face.sorted_vertices.end());
      faces.push_back(face);
    }
  std::sort(faces.begin(), faces.end());
  return faces;
}

// The three corner pairs of the facet between two corners' tets, in the minus tet's outward order.
std::array<std::array<std::uint8_t, 2>, 3> matched_corners(const TetMesh& mesh, Index minus, Index plus) {
  std::array<std::array<std::uint8_t, 2>, 3> pairs{};
  const TetCorners& a = mesh.tets[at(minus >> 2)];
  const TetCorners& b = mesh.tets[at(plus >> 2)];
  for (std::size_t k = 0; k < 3; ++k) {
    const auto local = at(facet_of_corner[at(minus & 3)][k]);
    const auto twin = std::find(b.begin(), b.end(), a[local]) - b.begin();
    pairs[k] = {static_cast<std::uint8_t>(local), static_cast<std::uint8_t>(twin)};
  }
  return pairs;
}

}  // namespace

Topology make_topology(const TetMesh& mesh) {
  Topology topology;
  topology.tet_nodes = mesh.tets;
  topology.tet_vertices = mesh.tets;
  topology.tet_facets.assign(mesh.tets.size(), {none, none, none, none});
  topology.vertex_of_node.resize(mesh.vertices.size());
  std::iota(topology.vertex_of_node.begin(), topology.vertex_of_node.end(), 0);

  const auto faces = sorted_faces(mesh);
  std::vector<std::pair<Index, Index>> interior;  // minus corner, plus corner
  for (std::size_t i = 0; i < faces.size();) {
    std::size_t j = i + 1;
    while (j < faces.size() && faces[j].sorted_vertices == faces[i].sorted_vertices) ++j;
    if (j - i > 2) {
      const auto& v = faces[i].sorted_vertices;
      throw InputError(fmt::format("mesh: {} tets share the facet of vertices {}, {}, {}; at most two may", j - i, v[0],
                                   v[1], v[2]));
    }
    if (j - i == 2)
      interior.emplace_back(faces[i].corner, faces[i + 1].corner);
    else
      topology.outer_facets.push_back(faces[i].corner);
    i = j;
  }
  // Facets numbered by their minus tet, so that a sweep over them walks the tets in order.
  std::sort(interior.begin(), interior.end());
  std::sort(topology.outer_facets.begin(), topology.outer_facets.end());
  topology.facet_tets.reserve(interior.size());
  topology.facet_corners.reserve(interior.size());
  for (const auto& [minus, plus] : interior) {
    const Index facet = topology.num_facets();
    topology.facet_tets.push_back({minus >> 2, plus >> 2});
    topology.facet_corners.push_back(matched_corners(mesh, minus, plus));
    topology.tet_facets[at(minus >> 2)][at(minus & 3)] = facet;
    topology.tet_facets[at(plus >> 2)][at(plus & 3)] = facet;
  }
  topology.facet_state.assign(topology.facet_tets.size(), FacetState::Bonded);

  std::vector<Index> vertex_of_corner;
  vertex_of_corner.reserve(mesh.tets.size() * 4);
  for (const auto& tet : mesh.tets) vertex_of_corner.insert(vertex_of_corner.end(), tet.begin(), tet.end());
  topology.corners_of_vertex = make_csr(mesh.num_vertices(), vertex_of_corner);
  return topology;
}

}  // namespace knap
