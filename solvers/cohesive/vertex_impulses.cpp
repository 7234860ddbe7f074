// A record passes through three regimes. Virgin: the impulse that keeps the faces together, within a capacity; a secant
// stiffness would be unstable as long as K w (1/m_a + 1/m_b) dt^2 is not small, so the record stays virgin until its
// opening passes the d_s at which it is. Softening: the secant force, explicit, plus contact. Failed: contact.
// The alternative, springs from the start, gains 15-65 % of the incident energy at insertion or costs the time step.
#include "cohesive/vertex_impulses.hpp"

#include <atomic>

#include "cohesive/vertex_kernel.hpp"
#include "core/parallel.hpp"

namespace knap {
namespace {

constexpr Index groups_per_block = 16;
// Virgin until K w (1/m_a + 1/m_b) dt^2 <= 1/3: about three records share a node, and the leapfrog limit is 4.
constexpr double virgin_stiffness_factor = 3.0;
// Damage that grows by less than this in a step does not keep an automatic run from stopping.
constexpr double noticeable_damage = 1e-5;

ImpulseCoefficients coefficients(const VertexImpulseOptions& options) {
  return {options.law, options.dt, options.sweeps, virgin_stiffness_factor * options.dt * options.dt,
          noticeable_damage};
}

ImpulseWorkspace& workspace() {
  thread_local ImpulseWorkspace memory;
  return memory;
}

// The groups that hold the vertices of some nodes, ascending.
std::vector<Index> groups_of_nodes(const CrackState& cracks, const Topology& topology, std::span<const Index> nodes) {
  std::vector<std::uint8_t> is_changed(cracks.groups.groups.size(), 0);
  for (const Index node : nodes) {
    const Index group = cracks.groups.group_of_vertex[at(topology.vertex_of_node[at(node)])];
    if (group != none) is_changed[at(group)] = 1;
  }
  std::vector<Index> changed;
  for (Index group = 0; group < to_index(is_changed.size()); ++group)
    if (is_changed[at(group)]) changed.push_back(group);
  return changed;
}

}  // namespace

bool apply_vertex_impulses(CrackState& cracks, NodalState& nodes, const VertexImpulseOptions& options) {
  const ImpulseView view{&cracks.groups,         cracks.records.data(),          cracks.faces.data(),
                         nodes.x.data()->data(), nodes.v.data()->data(),         nodes.v_before.data()->data(),
                         nodes.mass.data(),      cracks.losses_of_vertex.data(), cracks.step_losses_of_vertex.data()};
  const ImpulseCoefficients k = coefficients(options);
  const std::span<const RecordGroup> groups = cracks.groups.groups;
  std::atomic<bool> damaged{false};
  parallel_blocks(num_blocks(to_index(groups.size()), groups_per_block), [&](Index block) {
    const std::size_t first = at(block * groups_per_block);
    const std::size_t count = std::min(groups.size() - first, at(groups_per_block));
    if (solve_groups(view, k, groups.subspan(first, count), workspace()))
      damaged.store(true, std::memory_order_relaxed);
  });
  return damaged.load();
}

void settle_crack_losses(CrackState& cracks, const Topology& topology, const NodalState& nodes,
                         std::vector<Index> changed_nodes, const VertexImpulseOptions& options) {
  // Booking only reads records, faces and nodes.
  auto& now = const_cast<NodalState&>(nodes);
  const ImpulseView view{&cracks.groups,       cracks.records.data(),          cracks.faces.data(),
                         now.x.data()->data(), now.v.data()->data(),           now.v_before.data()->data(),
                         now.mass.data(),      cracks.losses_of_vertex.data(), cracks.step_losses_of_vertex.data()};
  const ImpulseCoefficients k = coefficients(options);
  const auto changed = groups_of_nodes(cracks, topology, changed_nodes);
  parallel_for(
      to_index(changed.size()),
      [&](Index i) { book_group(view, k, cracks.groups.groups[at(changed[at(i)])], workspace()); }, groups_per_block);
  for (const Index vertex : cracks.vertices)
    cracks.losses_of_vertex[at(vertex)] += cracks.step_losses_of_vertex[at(vertex)];
}

CrackEnergies& CrackEnergies::operator+=(const CrackEnergies& other) {
  stored += other.stored;
  losses += other.losses;
  return *this;
}

CrackEnergies crack_energies(const CrackState& cracks, const NodalState& nodes, const VertexImpulseOptions& options) {
  const CohesiveLaw& law = options.law;
  const double mode = law.beta * law.beta / law.kappa;
  return ordered_sum<CrackEnergies>(to_index(cracks.losses_of_vertex.size()), [&](Index vertex) {
    CrackEnergies sum{0.0, cracks.losses_of_vertex[at(vertex)]};
    for (const CrackRecord& record : cracks.records_of_vertex(vertex)) {
      if (record.regime != RecordRegime::Softening || record.is_closed_tip()) continue;
      const std::size_t a = at(record.node_a), b = at(record.node_b);
      const Vec3 n = xyz(cracks.faces[at(record.face)].normal);
      const Vec3 jump = xyz(nodes.x[b]) - xyz(nodes.x[a]);
      const Vec3 slip = xyz(nodes.v[b]) - xyz(nodes.v[a]);
      const double jn = jump.dot(n);
      const Vec3 tangential = jump - jn * n;
      const double stiffness = secant_stiffness(record.strength, record.d_max, record.delta_c);
      const double energy2 = energy_opening2(law, jn, tangential.squaredNorm());
      const double power = (std::max(jn, 0.0) * n + mode * tangential).dot(slip);
      sum.stored += 0.5 * stiffness * (energy2 + options.dt * power);
    }
    return sum;
  });
}

}  // namespace knap
