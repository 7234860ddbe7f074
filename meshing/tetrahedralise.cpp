#include "meshing/tetrahedralise.hpp"

#include <fmt/format.h>
#include <gmsh.h>

#include <unordered_map>

#include "core/errors.hpp"
#include "core/random.hpp"
#include "meshing/gmsh_session.hpp"
#include "meshing/mesh_quality.hpp"
#include "meshing/perturb.hpp"
#include "meshing/relax.hpp"
#include "meshing/reorder.hpp"
#include "meshing/shapes/geometry.hpp"
#include "meshing/size_field.hpp"
#include "meshing/vertex_star.hpp"

namespace knap {
namespace {

// gmsh's Delaunay mesher leaves interior edges 1.36 times the size asked for and surface edges 0.95 times. With this
// factor on the sizes inside, the mean edge is the size asked for.
constexpr double interior_size_factor = 0.72;
// Reached by nearly every mesh, with dihedral angles above 19 degrees; more than that no longer lengthens the time
// step.
constexpr double wanted_shape = 0.4;
constexpr double worst_shape_allowed = 0.01;
constexpr double most_tets = 2e7;  // some 10 GB in gmsh

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

// Moves the nodes of the surface mesh onto the shape.
void snap_gmsh_nodes(const Shape& shape) {
  std::vector<std::size_t> node_tags;
  std::vector<double> x, parameters;
  gmsh::model::mesh::getNodes(node_tags, x, parameters);
  for (std::size_t i = 0; i < node_tags.size(); ++i) {
    const Vec3 y = snapped_to_surface(shape, {x[3 * i], x[3 * i + 1], x[3 * i + 2]});
    gmsh::model::mesh::setNode(node_tags[i], {y.x(), y.y(), y.z()}, {});
  }
}

TetMesh gmsh_mesh(const Shape& shape, const TetrahedraliseOptions& options) {
  auto random = static_cast<std::uint64_t>(options.seed);
  const Mat3 orientation = options.seed == 0 ? Mat3::Identity() : random_rotation(random);
  TetMesh mesh;
  with_gmsh([&] {
    std::visit([&](const auto& s) { add_geometry(s, orientation); }, shape);
    add_size_field(options, options.seed != 0 && std::holds_alternative<Box>(shape));
    generate_mesh(2);
    snap_gmsh_nodes(shape);
    gmsh::option::setNumber("Mesh.MeshSizeFactor", interior_size_factor);
    generate_mesh(3);
    mesh = collect_mesh();
  });
  return mesh;
}

void snap_surface(TetMesh& mesh, const Shape& shape) {
  const std::vector<bool> on_surface = surface_vertices(mesh);
  for (std::size_t v = 0; v < on_surface.size(); ++v)
    if (on_surface[v]) mesh.vertices[v] = snapped_to_surface(shape, mesh.vertices[v]);
}

void check_options(const Shape& shape, const TetrahedraliseOptions& options) {
  const Vec3 lengths = extent(shape);
  const auto check = [](bool fine, const char* name, double value, const std::string& allowed) {
    if (!fine) throw InputError(fmt::format("{} is {:g}, allowed: {}", name, value, allowed));
  };
  check(lengths.allFinite() && lengths.minCoeff() > 0.0, "the particle's smallest size", lengths.minCoeff(),
        "above 0 m");
  const double h = options.element_size;
  check(h > 0.0 && h <= 0.5 * lengths.minCoeff(), "element_size", h,
        fmt::format("above 0 up to half the particle's smallest size, {:g} m", 0.5 * lengths.minCoeff()));
  const double contact_h = options.contact_element_size;
  check(contact_h >= 0.0 && contact_h <= h, "contact_element_size", contact_h,
        fmt::format("0 to element_size, {:g} m", h));
  check(options.contact_extent >= 0.0 && options.contact_extent < 100.0 * lengths.maxCoeff(), "contact_extent",
        options.contact_extent, "0 to 100 times the particle's size");
  check(!options.contact_points.empty(), "the number of contact points", 0.0, "at least one");
  for (const Vec3& point : options.contact_points)
    check(point.allFinite(), "a coordinate of a contact point", point.sum(), "finite numbers");
  check(options.perturbation >= 0.0 && options.perturbation <= 0.3, "perturbation", options.perturbation, "0 to 0.3");
  const double tets = expected_num_tets(shape, options);
  check(tets <= most_tets, "the number of tets", tets, fmt::format("up to {:g}; choose larger elements", most_tets));
}

TetrahedraliseOptions in_units_of(double unit, const TetrahedraliseOptions& options) {
  TetrahedraliseOptions scaled = options;
  scaled.element_size /= unit;
  scaled.contact_element_size /= unit;
  scaled.contact_extent /= unit;
  for (Vec3& point : scaled.contact_points) point /= unit;
  return scaled;
}

}  // namespace

TetMesh tetrahedralise(const Shape& shape, const TetrahedraliseOptions& options) {
  check_options(shape, options);
  const double unit = extent(shape).maxCoeff();  // gmsh's tolerances are absolute: let it work near 1
  TetMesh mesh = gmsh_mesh(scaled(shape, 1.0 / unit), in_units_of(unit, options));
  for (Vec3& vertex : mesh.vertices) vertex *= unit;
  snap_surface(mesh, shape);
  relax_worst_tets(mesh, shape, wanted_shape);
  if (options.perturbation > 0.0) perturb_interior(mesh, options.perturbation, options.seed);
  const double worst = measure_quality(mesh).min_shape;
  if (worst < worst_shape_allowed)
    throw RuntimeFailure(
        fmt::format("the mesh has a tet of shape quality {:g}: try another mesh seed or element_size", worst));
  return morton_ordered(mesh);
}

}  // namespace knap
