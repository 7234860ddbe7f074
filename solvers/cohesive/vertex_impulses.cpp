// A record passes through three regimes. Virgin: the impulse that keeps the faces together, within a capacity; a secant
// stiffness would be unstable as long as K w (1/m_a + 1/m_b) dt^2 is not small, so the record stays virgin until its
// opening passes the d_s at which it is. Softening: the secant force, explicit, plus contact. Failed: contact.
// The alternative, springs from the start, gains 15-65 % of the incident energy at insertion or costs the time step.
#include "cohesive/vertex_impulses.hpp"

#include "cohesive/crack_faces.hpp"
#include "cohesive/vertex_kernel.hpp"
#include "core/parallel.hpp"

namespace knap {
namespace {

constexpr Index groups_per_block = 16;
// Virgin until K w (1/m_a + 1/m_b) dt^2 <= 1/3: about three records share a node, and the leapfrog limit is 4.
constexpr double virgin_stiffness_factor = 3.0;

// By law.
std::vector<ImpulseCoefficients> coefficients(const VertexImpulseOptions& options) {
  std::vector<ImpulseCoefficients> all;
  for (const CohesiveLaw& law : options.laws)
    all.push_back({law, options.dt, options.sweeps, virgin_stiffness_factor * options.dt * options.dt});
  return all;
}

ImpulseWorkspace& workspace() {
  thread_local ImpulseWorkspace memory;
  return memory;
}

ImpulseView view(CrackState& cracks, NodalState& nodes) {
  return {&cracks.groups,
          cracks.record_offsets.data(),
          cracks.records.data(),
          cracks.faces.data(),
          nodes.x.data()->data(),
          nodes.v.data()->data(),
          nodes.v_before.data()->data(),
          nodes.mass.data(),
          cracks.losses_of_vertex.data(),
          cracks.step_losses_of_vertex.data(),
          cracks.any_sleeps};
}

// The cracked vertices of some nodes in the order of the groups, where neighbours have about as many records.
std::vector<Index> cracked_vertices(const CrackState& cracks, const Topology& topology, std::span<const Index> nodes) {
  std::vector<std::uint8_t> is_changed(cracks.losses_of_vertex.size(), 0);
  for (const Index node : nodes) is_changed[at(topology.vertex_of_node[at(node)])] = 1;
  std::vector<Index> vertices;
  for (const RecordGroup& group : cracks.groups.groups)
    for (const Index vertex : group.vertex)
      if (vertex != none && is_changed[at(vertex)]) vertices.push_back(vertex);
  return vertices;
}

}  // namespace

void apply_vertex_impulses(CrackState& cracks, NodalState& nodes, const VertexImpulseOptions& options) {
  const auto k = coefficients(options);
  const Index count = to_index(cracks.groups.groups.size());
  parallel_blocks(num_blocks(count, groups_per_block), [&](Index block) {
    const Index first = block * groups_per_block;
    solve_groups(view(cracks, nodes), k.data(), first, std::min(count, first + groups_per_block), workspace());
  });
}

void settle_crack_losses(CrackState& cracks, const Topology& topology, const NodalState& nodes,
                         const std::vector<Index>& changed_nodes, const VertexImpulseOptions& options) {
  const auto k = coefficients(options);
  const auto changed = cracked_vertices(cracks, topology, changed_nodes);
  const ImpulseView now = view(cracks, const_cast<NodalState&>(nodes));  // booking only reads the nodes
  const auto parts = parts_of_one_law(cracks, changed, group_lanes);
  parallel_for(
      to_index(parts.size()),
      [&](Index i) {
        const auto& part = parts[at(i)];
        book_vertices(now, k[at(law_of_vertex(cracks, part.front()))], part, workspace());
      },
      groups_per_block);
  for (const Index vertex : cracks.vertices)
    cracks.losses_of_vertex[at(vertex)] += cracks.step_losses_of_vertex[at(vertex)];
}

CrackEnergies& CrackEnergies::operator+=(const CrackEnergies& other) {
  stored += other.stored;
  losses += other.losses;
  return *this;
}

namespace {

// Stored energy [J] of a softening record, at the half step after positions x. Rigid bodies turn the jumps of sleeping
// records and nothing else.
double stored_energy(const CrackState& cracks, const CrackRecord& record, const NodalState& nodes,
                     const CohesiveLaw& law, double dt) {
  const std::size_t a = at(record.node_a), b = at(record.node_b);
  const CrackFace& face = cracks.faces[at(record.face)];
  const Vec3 n = face.sleeps ? mid_surface_normal(face, nodes.x) : Vec3(xyz(face.normal));
  const Vec3 jump = xyz(nodes.x[b]) - xyz(nodes.x[a]);
  const Vec3 slip = face.sleeps ? Vec3(Vec3::Zero()) : Vec3(xyz(nodes.v[b]) - xyz(nodes.v[a]));
  const double jn = jump.dot(n);
  const Vec3 tangential = jump - jn * n;
  const double stiffness = secant_stiffness(record.strength, record.d_max, record.delta_c);
  const double energy2 = energy_opening2(law, jn, tangential.squaredNorm());
  const double mode = law.beta * law.beta / law.kappa;
  const double power = (std::max(jn, 0.0) * n + mode * tangential).dot(slip);
  return 0.5 * stiffness * (energy2 + dt * power);
}

}  // namespace

CrackEnergies crack_energies(const CrackState& cracks, const NodalState& nodes, const VertexImpulseOptions& options) {
  return ordered_sum<CrackEnergies>(to_index(cracks.losses_of_vertex.size()), [&](Index vertex) {
    CrackEnergies sum{0.0, cracks.losses_of_vertex[at(vertex)]};
    const CohesiveLaw& law = options.laws[at(law_of_vertex(cracks, vertex))];
    for (const CrackRecord& record : cracks.records_of_vertex(vertex))
      if (record.regime == RecordRegime::Softening && !record.is_closed_tip())
        sum.stored += stored_energy(cracks, record, nodes, law, options.dt);
    return sum;
  });
}

}  // namespace knap
