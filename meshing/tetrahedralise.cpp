#include "meshing/tetrahedralise.hpp"

#include <fmt/format.h>
#include <gmsh.h>

#include <unordered_map>

#include "core/errors.hpp"
#include "core/topology.hpp"
#include "meshing/gmsh_session.hpp"
#include "meshing/reorder.hpp"
#include "meshing/shapes/geometry.hpp"
#include "meshing/size_field.hpp"
#include "meshing/split_mix.hpp"

namespace knap {
namespace {

// gmsh's Delaunay mesher leaves interior edges 1.36 times the size asked for and surface edges 0.95 times. With this
// factor on the sizes inside, the mean edge is the size asked for.
constexpr double interior_size_factor = 0.72;

// Turns what gmsh holds into a mesh, numbered in the order of gmsh's lists.
TetMesh collect_mesh() {
  std::vector<std::size_t> node_tags;
  std::vector<double> coordinates, parameters;
  gmsh::model::mesh::getNodes(node_tags, coordinates, parameters);
  std::unordered_map<std::size_t, Index> index_of_tag;
  TetMesh mesh;
  for (std::size_t i = 0; i < node_tags.size(); ++i) {
    index_of_tag.emplace(node_tags[i], to_index(i));
    mesh.vertices.emplace_back(coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]);
  }
  constexpr int four_node_tet = 4;
  std::vector<std::size_t> tet_tags, tet_nodes;
  gmsh::model::mesh::getElementsByType(four_node_tet, tet_tags, tet_nodes);
  for (std::size_t t = 0; t < tet_tags.size(); ++t) {
    TetCorners tet;
    for (std::size_t k = 0; k < 4; ++k) tet[k] = index_of_tag.at(tet_nodes[4 * t + k]);
    const auto& v = mesh.vertices;
    if (tet_volume(v[at(tet[0])], v[at(tet[1])], v[at(tet[2])], v[at(tet[3])]) < 0.0) std::swap(tet[2], tet[3]);
    mesh.tets.push_back(tet);
  }
  if (mesh.tets.empty()) throw RuntimeFailure("gmsh made no tets");
  return mesh;
}

TetMesh gmsh_mesh(const Shape& shape, const TetrahedraliseOptions& options) {
  SplitMix random{static_cast<std::uint64_t>(options.seed)};
  const Mat3 orientation = options.seed == 0 ? Mat3::Identity() : random_rotation(random);
  TetMesh mesh;
  with_gmsh([&] {
    std::visit([&](const auto& s) { add_geometry(s, orientation); }, shape);
    add_size_field(options, options.seed != 0 && std::holds_alternative<Box>(shape));
    gmsh::model::mesh::generate(2);
    gmsh::option::setNumber("Mesh.MeshSizeFactor", interior_size_factor);
    gmsh::model::mesh::generate(3);
    mesh = collect_mesh();
  });
  return mesh;
}

void snap_surface(TetMesh& mesh, const Shape& shape) {
  const Topology topology = make_topology(mesh);
  std::vector<bool> on_surface(mesh.vertices.size(), false);
  for (const Index corner : topology.outer_facets)
    for (const int k : facet_of_corner[at(corner & 3)]) on_surface[at(mesh.tets[at(corner >> 2)][at(k)])] = true;
  for (std::size_t v = 0; v < on_surface.size(); ++v)
    if (on_surface[v]) mesh.vertices[v] = snapped_to_surface(shape, mesh.vertices[v]);
}

}  // namespace

TetMesh tetrahedralise(const Shape& shape, const TetrahedraliseOptions& options) {
  const double unit = extent(shape).maxCoeff();  // gmsh's tolerances are absolute: let it work near 1
  TetrahedraliseOptions in_units = options;
  in_units.element_size /= unit;
  in_units.contact_element_size /= unit;
  in_units.contact_extent /= unit;
  in_units.contact_point /= unit;
  TetMesh mesh = gmsh_mesh(scaled(shape, 1.0 / unit), in_units);
  for (Vec3& vertex : mesh.vertices) vertex *= unit;
  snap_surface(mesh, shape);
  return morton_ordered(mesh);
}

}  // namespace knap
