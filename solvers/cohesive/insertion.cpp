#include "cohesive/insertion.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "cohesive/crack_faces.hpp"
#include "cohesive/intrinsic_bonds.hpp"

namespace knap {
namespace {

// Groups of a star's corners joined by bonded facets: group[i] is the lowest index in the star of i's group.
std::vector<Index> bonded_groups(const Topology& topology, std::span<const Index> star) {
  std::vector<Index> parent(star.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&parent](Index i) {
    while (parent[at(i)] != i) i = parent[at(i)];
    return i;
  };
  for (Index i = 0; i < to_index(star.size()); ++i) {
    const Index tet = star[at(i)] >> 2;
    for (Index local = 0; local < 4; ++local) {
      const Index facet = topology.tet_facets[at(tet)][at(local)];
      if (local == (star[at(i)] & 3) || facet == none) continue;
      if (topology.facet_state[at(facet)] != FacetState::Bonded) continue;
      const auto& sides = topology.facet_tets[at(facet)];
      const Index other = sides[0] == tet ? sides[1] : sides[0];
      if (other < tet) continue;  // each facet once
      const auto found = std::lower_bound(star.begin(), star.end(), 4 * other);
      assert(found != star.end() && (*found >> 2) == other);
      const Index a = root(i);
      const Index b = root(to_index(at(static_cast<Index>(found - star.begin()))));
      parent[at(std::max(a, b))] = std::min(a, b);
    }
  }
  for (Index i = 0; i < to_index(star.size()); ++i) parent[at(i)] = root(i);
  return parent;
}

/// What scaling has added to a node beside the masses of its corners [kg].
struct AddedMass {
  Index node = none;
  double mass = 0.0;
};
std::vector<AddedMass> added_masses(const Topology& topology, const NodalState& nodes, std::span<const Index> star,
                                    std::span<const double> corner_mass) {
  constexpr double round_off = 1e-12;
  std::vector<AddedMass> added;
  for (const Index corner : star) {
    const Index node = topology.node_of_corner(corner);
    const auto is_node = [node](const AddedMass& a) { return a.node == node; };
    if (std::any_of(added.begin(), added.end(), is_node)) continue;
    double own = 0.0;
    for (const Index other : star)
      if (topology.node_of_corner(other) == node) own += corner_mass[at(other >> 2)];
    const double mass = nodes.mass[at(node)] - own;
    added.push_back({node, mass > round_off * own ? mass : 0.0});
  }
  return added;
}

void sum_masses(const Topology& topology, NodalState& nodes, std::span<const Index> star,
                std::span<const double> corner_mass) {
  for (const Index corner : star) nodes.mass[at(topology.node_of_corner(corner))] = 0.0;
  for (const Index corner : star) nodes.mass[at(topology.node_of_corner(corner))] += corner_mass[at(corner >> 2)];
}

bool was_bond(const InsertionOptions& options, Index facet) {
  return !options.bond_stiffness.empty() && options.bond_stiffness[at(facet)] > 0.0;
}

// All interior facets of a particle are bonds, or none is.
bool has_bonds_at(const Topology& topology, Index vertex, const InsertionOptions& options) {
  for (const Index corner : topology.corners_of_vertex[vertex])
    for (const Index facet : topology.tet_facets[at(corner >> 2)])
      if (facet != none) return was_bond(options, facet);
  return false;
}

// The nodes of the records at a vertex follow its corners; records whose two sides have just come apart are activated.
void refresh_records(CrackState& cracks, const Topology& topology, Index vertex, const InsertionOptions& options) {
  for (CrackRecord& record : cracks.records_of_vertex(vertex)) {
    CrackFace& face = cracks.faces[at(record.face)];
    const bool was_active = record.node_a != record.node_b;
    record.node_a = topology.facet_node(face.facet, record.corner, 0);
    record.node_b = topology.facet_node(face.facet, record.corner, 1);
    face.nodes[record.corner] = {record.node_a, record.node_b};
    if (was_active || record.node_a == record.node_b || was_bond(options, face.facet)) continue;
    const auto& [minus, plus] = topology.facet_tets[at(face.facet)];
    const Vec3 t = facet_traction(options.stress[at(minus)], options.stress[at(plus)], xyz(face.normal));
    record.impulse = -options.dt * face.area / 3.0 * t;
  }
}

CrackFace new_face(const Topology& topology, const NodalState& nodes, Index facet, double area) {
  CrackFace face;
  face.facet = facet;
  face.area = area;
  for (int k = 0; k < 3; ++k) face.nodes[at(k)] = {topology.facet_node(facet, k, 0), topology.facet_node(facet, k, 1)};
  update_normal(face, nodes.x);
  return face;
}

// Faces and records of the facets; the records of a vertex in the order of the facets.
void open_facets(CrackState& cracks, Topology& topology, const NodalState& nodes,
                 std::span<const OverloadedFacet> facets, const InsertionOptions& options) {
  std::vector<CrackFace> faces;
  std::vector<VertexRecord> records;
  for (const OverloadedFacet& overloaded : facets) {
    const Index facet = overloaded.facet;
    topology.facet_state[at(facet)] = FacetState::Cohesive;
    const double area = options.facet_area[at(facet)];
    cracks.cracked_area += area;
    for (int k = 0; k < 3; ++k) {
      CrackRecord record;
      record.strength = area / 3.0 * overloaded.effective;
      record.delta_c = 2.0 * options.fracture_energy[at(facet)] / overloaded.effective;
      record.face = to_index(faces.size());
      record.corner = static_cast<std::uint8_t>(k);
      records.push_back({topology.facet_vertex(facet, k), record});
    }
    faces.push_back(new_face(topology, nodes, facet, area));
  }
  std::stable_sort(records.begin(), records.end(),
                   [](const VertexRecord& a, const VertexRecord& b) { return a.vertex < b.vertex; });
  add_cracks(cracks, faces, records);
}

// The springs of a bond have let go; what they held beyond the records is lost as in a closing crack.
void soften_bond_of(Index facet, CrackState& cracks, const Topology& topology, const NodalState& nodes,
                    const InsertionOptions& options) {
  const Index slot = cracks.face_of_facet[at(facet)];
  const CrackFace& face = cracks.faces[at(slot)];
  for (int k = 0; k < 3; ++k) {
    const Index vertex = topology.facet_vertex(facet, k);
    for (CrackRecord& record : cracks.records_of_vertex(vertex)) {
      if (record.face != slot) continue;
      cracks.losses_of_vertex[at(vertex)].closure +=
          soften_bond(record, options.laws.of(topology.facet_tets[at(facet)][0]),
                      {.stiffness = options.bond_stiffness[at(facet)],
                       .area = face.area / 3.0,
                       .jump = xyz(nodes.x[at(record.node_b)]) - xyz(nodes.x[at(record.node_a)]),
                       .normal = xyz(face.normal),
                       .dt = options.dt});
    }
  }
}

void sort_unique(std::vector<Index>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace

std::vector<Index> split_vertex(Topology& topology, NodalState& nodes, Index vertex,
                                std::span<const double> corner_mass) {
  const auto star = topology.corners_of_vertex[vertex];
  const auto group = bonded_groups(topology, star);
  const auto added = added_masses(topology, nodes, star, corner_mass);
  std::vector<std::pair<Index, Index>> owner;  // old node, the group that keeps it
  std::vector<Index> new_node(star.size(), none);
  std::vector<Index> changed;
  for (Index i = 0; i < to_index(star.size()); ++i) {
    const Index corner = star[at(i)];
    Index& node = topology.tet_nodes[at(corner >> 2)][at(corner & 3)];
    const Index g = group[at(i)];
    if (new_node[at(g)] == none) {  // first corner of its group
      const auto kept =
          std::find_if(owner.begin(), owner.end(), [node](const auto& pair) { return pair.first == node; });
      if (kept == owner.end()) {
        owner.emplace_back(node, g);
        new_node[at(g)] = node;
      } else {
        new_node[at(g)] = append_copy(nodes, node);
        topology.vertex_of_node.push_back(vertex);
      }
    }
    if (node == new_node[at(g)]) continue;
    node = new_node[at(g)];
    changed.push_back(corner >> 2);
  }
  if (changed.empty()) return changed;
  sum_masses(topology, nodes, star, corner_mass);
  for (const AddedMass& a : added) nodes.mass[at(a.node)] += a.mass;
  return changed;
}

InsertionChange insert_cracks(CrackState& cracks, Topology& topology, NodalState& nodes,
                              std::span<const OverloadedFacet> facets, const InsertionOptions& options) {
  open_facets(cracks, topology, nodes, facets, options);
  InsertionChange change;
  for (const OverloadedFacet& overloaded : facets)
    for (int k = 0; k < 3; ++k) change.split_vertices.push_back(topology.facet_vertex(overloaded.facet, k));
  sort_unique(change.split_vertices);
  for (const Index vertex : change.split_vertices) {
    if (has_bonds_at(topology, vertex, options)) continue;
    const auto changed = split_vertex(topology, nodes, vertex, options.corner_mass);
    change.changed_tets.insert(change.changed_tets.end(), changed.begin(), changed.end());
  }
  for (const Index vertex : change.split_vertices) refresh_records(cracks, topology, vertex, options);
  for (const OverloadedFacet& overloaded : facets)
    if (was_bond(options, overloaded.facet)) soften_bond_of(overloaded.facet, cracks, topology, nodes, options);
  group_records(cracks);
  sort_unique(change.changed_tets);
  return change;
}

}  // namespace knap
