#include "fem/elastic_force.hpp"

#include <fmt/format.h>

#include "core/errors.hpp"
#include "core/parallel.hpp"
#include "fem/tet_reference.hpp"

namespace knap {
namespace {

constexpr std::array<std::array<int, 2>, 6> symmetric_entries{{{0, 0}, {1, 1}, {2, 2}, {1, 2}, {2, 0}, {0, 1}}};

void store(const Mat3& symmetric, SymmetricLanes& s, Index lane) {
  for (std::size_t i = 0; i < 6; ++i) s[i][at(lane)] = symmetric(symmetric_entries[i][0], symmetric_entries[i][1]);
}

KernelCoefficients coefficients(const Material& material, double decay) {
  const Lame l = material.small_strain();
  const double ratio = material.branch.ratio;
  return {l.mu, l.lambda + l.mu, 6.0 * ratio * l.lambda / (l.mu * l.mu), 12.0 * ratio / l.mu, decay};
}

BlockView view(const ElasticForce& elastic, BranchGroup* branch, Index b, std::span<const Vec4> x) {
  const ElementBlock& block = elastic.blocks.blocks[at(b)];
  return {elastic.groups.data() + block.first_group, branch ? branch + block.first_group : nullptr,
          elastic.blocks.corners.data() + block.first_group * lanes, &block, x.data()->data()};
}

// Fills one lane from a tet's reference state.
void set_element(ElasticForce& elastic, Index group, Index lane, const TetReference& tet) {
  const double mu = elastic.material.small_strain().mu;
  const Mat3 inverse_metric = tet.inverse_edges * tet.inverse_edges.transpose();
  store(-mu * tet.volume * inverse_metric, elastic.groups[at(group)].stiffness, lane);
  elastic.groups[at(group)].inverse_six_volume[at(lane)] = 1.0 / (6.0 * tet.volume);
  if (!elastic.material.branch.is_active()) return;
  const Mat3 edges = tet.inverse_edges.inverse();
  store(edges.transpose() * edges, elastic.branch.groups[at(group)].relaxed_metric, lane);
}

void sum_interface(const ElasticForce& elastic, std::span<Vec4> f) {
  const ElementBlocks& blocks = elastic.blocks;
  parallel_for(to_index(blocks.interface_nodes.size()), [&](Index i) {
    const auto slots = blocks.slots_of_interface[i];
    Vec4 sum = slots.empty() ? Vec4::Zero() : elastic.interface_forces[at(slots[0])];
    for (std::size_t s = 1; s < slots.size(); ++s) sum += elastic.interface_forces[at(slots[s])];
    f[at(blocks.interface_nodes[at(i)])] = sum;
  });
}

void book_branch(BranchState& branch, double decay, double stored) {
  const double kept = decay * decay;
  branch.dissipated += branch.pending + (1.0 / kept - 1.0) * stored;
  branch.pending = (1.0 - kept) * stored;
  branch.stored = stored;
  branch.decay = decay;
}

}  // namespace

ElasticForce make_elastic_force(const Topology& topology, std::span<const Vec3> reference_positions,
                                const Material& material) {
  ElasticForce elastic;
  elastic.material = material;
  elastic.blocks = make_element_blocks(topology);
  elastic.groups.resize(at(elastic.blocks.num_groups));
  if (material.branch.is_active()) elastic.branch.groups.resize(at(elastic.blocks.num_groups));
  elastic.stress.resize(at(topology.num_tets()));
  elastic.stress_bound.resize(at(topology.num_tets()));
  elastic.interface_forces.resize(at(elastic.blocks.num_slots));
  for (const ElementBlock& block : elastic.blocks.blocks)
    for (Index group = 0; group < block.num_groups; ++group)
      for (Index lane = 0; lane < lanes; ++lane) {
        const Index t = tet_of_lane(block, group, lane);
        if (t == none) continue;
        const TetReference tet = make_tet_reference(reference_positions, topology.tet_vertices[at(t)]);
        if (!(tet.volume > 0.0)) throw InputError(fmt::format("mesh: tet {} has volume {} m3", t, tet.volume));
        set_element(elastic, block.first_group + group, lane, tet);
      }
  return elastic;
}

void refresh_elastic_force(ElasticForce& elastic, const Topology& topology, std::span<const Index> changed_tets) {
  refresh_blocks(elastic.blocks, topology, changed_tets);
  elastic.interface_forces.resize(at(elastic.blocks.num_slots));
}

void update_elastic_forces(ElasticForce& elastic, std::span<const Vec4> x, std::span<Vec4> f, double dt) {
  const double decay = elastic.material.branch.half_step_decay(dt);
  const KernelCoefficients k = coefficients(elastic.material, decay);
  BranchGroup* branch = elastic.branch.groups.empty() ? nullptr : elastic.branch.groups.data();
  double* slots = elastic.interface_forces.empty() ? nullptr : elastic.interface_forces.data()->data();
  const double stored = ordered_sum<double>(
      to_index(elastic.blocks.blocks.size()),
      [&](Index b) { return add_block_forces(view(elastic, branch, b, x), k, f.data()->data(), slots); }, 1);
  sum_interface(elastic, f);
  if (branch) book_branch(elastic.branch, decay, stored);
}

BulkState bulk_state(const ElasticForce& elastic, std::span<const Vec4> x) {
  const KernelCoefficients k = coefficients(elastic.material, elastic.branch.decay);
  // The energy sweep only reads the branch.
  auto* branch = elastic.branch.groups.empty() ? nullptr : const_cast<BranchGroup*>(elastic.branch.groups.data());
  return ordered_sum<BulkState>(
      to_index(elastic.blocks.blocks.size()), [&](Index b) { return block_state(view(elastic, branch, b, x), k); }, 1);
}

double strain_energy(const ElasticForce& elastic, std::span<const Vec4> x) {
  return bulk_state(elastic, x).strain_energy;
}

void update_stress(ElasticForce& elastic, std::span<const Vec4> x) {
  const KernelCoefficients k = coefficients(elastic.material, elastic.branch.decay);
  BranchGroup* branch = elastic.branch.groups.empty() ? nullptr : elastic.branch.groups.data();
  parallel_blocks(to_index(elastic.blocks.blocks.size()), [&](Index b) {
    store_block_stress(view(elastic, branch, b, x), k, elastic.stress.data(), elastic.stress_bound.data());
  });
}

}  // namespace knap
