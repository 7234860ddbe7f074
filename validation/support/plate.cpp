#include "validation/support/plate.hpp"

#include <limits>

#include "meshing/reorder.hpp"
#include "meshing/tetrahedralise.hpp"
#include "simulation/initial_cracks.hpp"
#include "tests/support/bar_mesh.hpp"

namespace knap {
namespace {

Vec3 centroid(std::span<const Vec3> vertices, const TetCorners& tet) {
  Vec3 sum = Vec3::Zero();
  for (const Index vertex : tet) sum += vertices[at(vertex)];
  return 0.25 * sum;
}

}  // namespace

TetMesh plate_mesh(const PlateOptions& plate) {
  if (plate.is_aligned) {
    std::array<Index, 3> cells;
    for (int k = 0; k < 3; ++k)
      cells[at(k)] = std::max(Index{1}, static_cast<Index>(std::lround(plate.lengths[k] / plate.element)));
    TetMesh mesh = bar_mesh(cells, 1.0);
    for (Vec3& x : mesh.vertices)
      for (int k = 0; k < 3; ++k) x[k] *= plate.lengths[k] / cells[at(k)];
    return morton_ordered(mesh);
  }
  TetrahedraliseOptions options;
  options.element_size = plate.element;
  options.seed = plate.seed;
  TetMesh mesh = tetrahedralise(Box{plate.lengths}, options);
  for (Vec3& x : mesh.vertices) x += 0.5 * plate.lengths;
  return mesh;
}

TetMesh graded_plate(std::span<const double> x, std::span<const double> y, double thickness) {
  TetMesh mesh = bar_mesh({to_index(x.size()) - 1, to_index(y.size()) - 1, 1}, 1.0);
  for (Vec3& v : mesh.vertices)
    v = {x[static_cast<std::size_t>(std::lround(v.x()))], y[static_cast<std::size_t>(std::lround(v.y()))],
         thickness * v.z()};
  return morton_ordered(mesh);
}

std::vector<double> stretched(double from, double to, double first, double growth) {
  std::vector<double> places{0.0};
  for (double size = first; places.back() < (1.0 - 1e-9) * std::abs(to - from); size *= growth)
    places.push_back(places.back() + size);
  const double scale = (to - from) / places.back();
  for (double& place : places) place = from + scale * place;
  return places;
}

std::vector<Index> vertices_where(const TetMesh& mesh, const Where& is_there) {
  std::vector<Index> vertices;
  for (Index i = 0; i < mesh.num_vertices(); ++i)
    if (is_there(mesh.vertices[at(i)])) vertices.push_back(i);
  return vertices;
}

TetMesh without_tets(const TetMesh& mesh, const Where& is_there) {
  TetMesh rest{mesh.vertices, {}};
  for (const TetCorners& tet : mesh.tets)
    if (!is_there(centroid(mesh.vertices, tet))) rest.tets.push_back(tet);
  return morton_ordered(rest);
}

PrescribedOptions plane_strain(const TetMesh& mesh) {
  const BoundingBox box = bounding_box(mesh);
  const double margin = 1e-6 * (box.high.z() - box.low.z());
  const auto on_face = [&](const Vec3& x) { return x.z() < box.low.z() + margin || x.z() > box.high.z() - margin; };
  return {.vertices = vertices_where(mesh, on_face), .axes = {false, false, true}};
}

std::vector<PrescribedOptions> bending(const TetMesh& mesh, const BeamLoad& load) {
  const auto is_on = [](double x, double place) { return std::abs(x - place) < 1e-9; };
  const auto on_supports = [&](const Vec3& v) {
    return is_on(v.y(), 0.0) && (is_on(v.x(), load.supports[0]) || is_on(v.x(), load.supports[1]));
  };
  const auto on_load = [&](const Vec3& v) { return is_on(v.y(), load.top) && is_on(v.x(), load.place); };
  const double ramp = 0.3 * load.duration;
  return {plane_strain(mesh),
          {.vertices = vertices_where(mesh, on_supports), .axes = {false, true, false}},
          {.vertices = vertices_where(mesh, on_load),
           .axes = {true, true, false},
           .velocity = {0.0, -load.way / (load.duration - 0.5 * ramp), 0.0},
           .ramp_time = ramp}};
}

Vec3 facet_middle(const Simulation& s, Index facet) {
  Vec3 sum = Vec3::Zero();
  for (int k = 0; k < 3; ++k) sum += s.reference.vertices[at(s.topology.facet_vertex(facet, k))];
  return sum / 3.0;
}

std::vector<Index> facets_between(const Simulation& s, int axis, double place) {
  std::vector<Index> facets;
  const auto is_above = [&](Index tet) {
    return centroid(s.reference.vertices, s.topology.tet_vertices[at(tet)])[axis] > place;
  };
  for (Index f = 0; f < s.topology.num_facets(); ++f) {
    const auto& [minus, plus] = s.topology.facet_tets[at(f)];
    if (is_above(minus) != is_above(plus)) facets.push_back(f);
  }
  return facets;
}

void open_slit(Simulation& s, std::span<const Index> facets, const Where& is_there, const Where& is_zone) {
  std::vector<InitialCrack> cracks;
  for (const Index f : facets)
    if (const Vec3 x = facet_middle(s, f); is_there(x) || is_zone(x)) {
      const double damage = is_there(x) ? 1.0 : 0.0;
      cracks.push_back({.facet = f, .strength = s.reference.facet_strength[at(f)], .damage = {damage, damage, damage}});
    }
  open_initial_cracks(s, cracks);
}

void break_only(Simulation& s, const std::function<bool(Index)>& may_break) {
  for (Index f = 0; f < s.topology.num_facets(); ++f)
    if (!may_break(f)) s.reference.facet_strength[at(f)] = std::numeric_limits<double>::infinity();
}

void break_only(Simulation& s, std::span<const Index> facets) {
  std::vector<bool> may_break(at(s.topology.num_facets()), false);
  for (const Index f : facets) may_break[at(f)] = true;
  break_only(s, [&](Index f) { return may_break[at(f)]; });
}

bool has_failed(const Simulation& s, Index facet) {
  const FacetState state = s.topology.facet_state[at(facet)];
  return state == FacetState::Failed || state == FacetState::HandedOver;
}

}  // namespace knap
