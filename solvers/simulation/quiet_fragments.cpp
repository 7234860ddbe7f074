#include "simulation/quiet_fragments.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/parallel.hpp"
#include "fem/tet_reference.hpp"

namespace knap {
namespace {

constexpr Index fragments_per_block = 16;
// What is this much of the mean edge from a tool is not frozen: it would soon have to wake.
constexpr double clear_of_tools = 0.1;

Index other_side(const Topology& topology, Index facet, Index tet) {
  const auto& sides = topology.facet_tets[at(facet)];
  return sides[0] == tet ? sides[1] : sides[0];
}

double mean_damage(const CrackState& cracks, const Topology& topology, const CrackFace& face) {
  double sum = 0.0;
  const Index slot = cracks.face_of_facet[at(face.facet)];
  for (int k = 0; k < 3; ++k)
    for (const CrackRecord& record : cracks.records_of_vertex(topology.facet_vertex(face.facet, k)))
      if (record.face == slot) sum += record.damage() / 3.0;
  return sum;
}

// Its crack faces towards other fragments are all in the hands of the general contact.
bool has_come_loose(const Simulation& s, std::span<const Index> tets) {
  const auto& label = s.contact.fragment_of_tet;
  for (const Index tet : tets)
    for (const Index facet : s.topology.tet_facets[at(tet)])
      if (facet != none && s.topology.facet_state[at(facet)] != FacetState::HandedOver &&
          label[at(other_side(s.topology, facet, tet))] != label[at(tet)])
        return false;
  return true;
}

// Damage does not count: a ligament nearly torn through would else keep its fragment from ever freezing.
double weakest_facet(const Simulation& s, std::span<const Index> tets) {
  double weakest = RigidBody::unbreakable;
  for (const Index tet : tets)
    for (const Index facet : s.topology.tet_facets[at(tet)]) {
      if (facet == none || s.topology.facet_tets[at(facet)][0] != tet) continue;  // each facet once
      const FacetState state = s.topology.facet_state[at(facet)];
      if (state == FacetState::Bonded || state == FacetState::Cohesive)
        weakest = std::min(weakest, s.reference.facet_strength[at(facet)]);
    }
  return weakest;
}

double fragment_volume(const Simulation& s, std::span<const Index> tets) {
  double volume = 0.0;
  for (const Index tet : tets) volume += s.reference.tet_volume[at(tet)];
  return volume;
}

const Material& material_of(const ElasticForce& elastic, Index tet) {
  return elastic.materials[at(elastic.blocks.blocks[at(elastic.blocks.block_of_tet[at(tet)])].material)];
}

// The speed of impact on a rigid wall at which Hertz's peak force F puts 0.9 F/d^2 at the strength of a sphere [m/s]:
// F/d^2 = 0.7574 E*^0.4 (rho v^2)^0.6.
double critical_speed(const Material& material, double strength) {
  const Lame l = material.small_strain();
  const double nu = poisson_ratio(l);
  const double modulus = young_modulus(l) / (1.0 - nu * nu);
  return std::pow(strength / (0.682 * std::pow(modulus, 0.4)), 5.0 / 6.0) / std::sqrt(material.density);
}

double fragment_size(const Simulation& s, std::span<const Index> tets) {
  return std::cbrt(6.0 * fragment_volume(s, tets) / std::numbers::pi);
}

double crossing_time(const Simulation& s, std::span<const Index> tets) {
  const Material& material = material_of(s.elastic, tets[0]);
  return fragment_size(s, tets) / p_wave_speed(material.small_strain(), material.density);
}

bool is_quiet(const Simulation& s, std::span<const Index> tets) {
  std::int64_t last = 0;
  for (const Index tet : tets) last = std::max(last, s.freezing.last_change[at(tet)]);
  const RigidFragmentOptions& options = s.options.rigid_fragments;
  const auto steps = s.clock.step - last;
  return steps >= options.quiet_steps &&
         static_cast<double>(steps) * s.clock.dt >= options.quiet_crossings * crossing_time(s, tets);
}

std::vector<Index> nodes_of(const Topology& topology, std::span<const Index> tets) {
  std::vector<Index> nodes;
  for (const Index tet : tets)
    nodes.insert(nodes.end(), topology.tet_nodes[at(tet)].begin(), topology.tet_nodes[at(tet)].end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

// A mesh whose tets meet at a vertex or an edge only has fragments that share nodes.
bool has_nodes_of_its_own(const Simulation& s, std::span<const Index> nodes, Index label) {
  for (const Index node : nodes)
    for (const Index corner : s.topology.corners_of_vertex[s.topology.vertex_of_node[at(node)]])
      if (s.topology.node_of_corner(corner) == node && s.contact.fragment_of_tet[at(corner >> 2)] != label)
        return false;
  return true;
}

double strain_energy(const Simulation& s, std::span<const Index> tets) {
  const auto x = [&s](Index node) -> Vec3 { return xyz(s.nodes.x[at(node)]); };
  return std::visit(
      [&](const auto& law) {
        double sum = 0.0;
        for (const Index tet : tets) {
          const auto& n = s.topology.tet_nodes[at(tet)];
          const TetReference reference = make_tet_reference(s.reference.vertices, s.topology.tet_vertices[at(tet)]);
          const Mat3 F = deformation_gradient(reference, x(n[0]), x(n[1]), x(n[2]), x(n[3]));
          sum += reference.volume * energy_density(law, F);
        }
        return sum;
      },
      material_of(s.elastic, tets[0]).law);
}

double kinetic_energy_of(const NodalState& state, std::span<const Index> nodes) {
  double sum = 0.0;
  for (const Index node : nodes) sum += 0.5 * state.mass[at(node)] * state.v[at(node)].squaredNorm();
  return sum;
}

// Mass, motion and what it takes to break it.
RigidBody rigid_body(const Simulation& s, std::span<const Index> tets, std::span<const Index> nodes) {
  RigidBody body = make_rigid_body(nodes, s.nodes);
  body.size = fragment_size(s, tets);
  body.strength = weakest_facet(s, tets);
  body.critical_speed = critical_speed(material_of(s.elastic, tets[0]), body.strength);
  body.crossing_time = crossing_time(s, tets);
  body.strain_energy = strain_energy(s, tets);
  return body;
}

bool may_freeze(const Simulation& s, const QuietFragment& fragment) {
  if (!fragment.body.can_break()) return true;
  const double modulus = young_modulus(material_of(s.elastic, fragment.tets[0]).small_strain());
  const double strength = fragment.body.strength;
  const double limit = 0.5 * strength * strength / modulus * fragment_volume(s, fragment.tets);
  const RigidFragmentOptions& options = s.options.rigid_fragments;
  return fragment.body.strain_energy <= options.strain_share * limit &&
         fragment.vibration <= options.vibration_share * limit;
}

// A particle that is still whole is computed as long as it moves: its rebound is elastic, whatever its speed.
bool is_a_piece(const Simulation& s, std::span<const Index> tets) {
  const auto& label = s.contact.fragment_of_tet;
  for (const Index tet : tets)
    for (const Index facet : s.topology.tet_facets[at(tet)])
      if (facet != none && label[at(other_side(s.topology, facet, tet))] != label[at(tet)]) return true;
  return false;
}

std::optional<QuietFragment> quiet_fragment(const Simulation& s, std::span<const Index> tets) {
  if (s.rigid.of_tet(tets[0]) != none || !(s.options.rigid_fragments.whole || is_a_piece(s, tets))) return std::nullopt;
  const bool is_loose = has_come_loose(s, tets);
  if (!(is_loose && weakest_facet(s, tets) == RigidBody::unbreakable) && !is_quiet(s, tets)) return std::nullopt;
  QuietFragment fragment{{tets.begin(), tets.end()}, nodes_of(s.topology, tets), {}, 0.0, is_loose};
  if (!has_nodes_of_its_own(s, fragment.nodes, s.contact.fragment_of_tet[at(tets[0])])) return std::nullopt;
  fragment.body = rigid_body(s, tets, fragment.nodes);
  fragment.vibration = kinetic_energy_of(s.nodes, fragment.nodes) - kinetic_energy(fragment.body);
  if (!may_freeze(s, fragment)) return std::nullopt;
  if (is_near_triangulated_tool(s, fragment.nodes, fragment.body, clear_of_tools * s.reference.mean_edge))
    return std::nullopt;
  return fragment;
}

}  // namespace

bool is_near_triangulated_tool(const Simulation& s, std::span<const Index> nodes, const RigidBody& body,
                               double distance) {
  for (const Tool& tool : s.tools) {
    if (!std::holds_alternative<SurfaceTool>(tool.shape)) continue;
    if (proximity(tool, body.centre).gap > body.radius + distance) continue;
    for (const Index node : nodes)
      if (proximity(tool, xyz(s.nodes.x[at(node)])).gap <= distance) return true;
  }
  return false;
}

// A facet cracked since the last look counts as a change whatever its damage.
void note_changes(Simulation& s) {
  FreezingState& freezing = s.freezing;
  if (freezing.last_change.empty()) {
    freezing.last_change.assign(at(s.topology.num_tets()), 0);
    freezing.noted_damage.assign(at(s.topology.num_facets()), -1.0);
  }
  for (const CrackFace& face : s.cracks.faces) {
    if (face.sleeps) continue;
    const double damage = mean_damage(s.cracks, s.topology, face);
    double& noted = freezing.noted_damage[at(face.facet)];
    if (noted >= 0.0 && damage - noted <= s.options.rigid_fragments.noticeable_damage) continue;
    noted = damage;
    for (const Index tet : s.topology.facet_tets[at(face.facet)]) freezing.last_change[at(tet)] = s.clock.step;
  }
}

std::vector<QuietFragment> quiet_fragments(const Simulation& s) {
  const Csr tets_of_fragment = make_csr(s.contact.fragments, s.contact.fragment_of_tet);
  std::vector<std::optional<QuietFragment>> found(at(tets_of_fragment.num_rows()));
  parallel_for(
      tets_of_fragment.num_rows(), [&](Index f) { found[at(f)] = quiet_fragment(s, tets_of_fragment[f]); },
      fragments_per_block);
  std::vector<QuietFragment> chosen;
  double lost = s.freezing.vibration;
  const double allowed = s.options.rigid_fragments.loss_share * s.ledger.reference;
  for (auto& fragment : found) {
    if (!fragment || lost + fragment->vibration > allowed) continue;
    lost += fragment->vibration;
    chosen.push_back(std::move(*fragment));
  }
  return chosen;
}

}  // namespace knap
