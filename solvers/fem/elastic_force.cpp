#include "fem/elastic_force.hpp"

#include <algorithm>

#include "core/parallel.hpp"
#include "fem/element_lanes.hpp"

namespace knap {
namespace {

KernelCoefficients coefficients(const Material& material, double decay) {
  const Lame l = material.small_strain();
  const double ratio = material.branch.ratio;
  return {l.mu, l.lambda + l.mu, 6.0 * ratio * l.lambda / (l.mu * l.mu), 12.0 * ratio / l.mu, decay};
}

// By material.
std::vector<KernelCoefficients> coefficients(const ElasticForce& elastic, double dt) {
  std::vector<KernelCoefficients> all;
  for (const Material& material : elastic.materials)
    all.push_back(coefficients(material, material.branch.half_step_decay(dt)));
  return all;
}

// The energy and stress sweeps only read the branch.
BranchGroup* branch_groups(const ElasticForce& elastic) {
  return elastic.branch.groups.empty() ? nullptr : const_cast<BranchGroup*>(elastic.branch.groups.data());
}

BlockView view(const ElasticForce& elastic, Index b, std::span<const Vec4> x) {
  const ElementBlock& block = elastic.blocks.blocks[at(b)];
  BranchGroup* branch =
      elastic.materials[at(block.material)].branch.is_active() ? branch_groups(elastic) + block.first_group : nullptr;
  return {elastic.groups.data() + block.first_group, branch, elastic.blocks.corners.data() + block.first_group * lanes,
          &block, x.data()->data()};
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

void book_branch(ElasticForce& elastic, double dt, std::span<const double> stored_of_block) {
  std::vector<double> stored_of_material(elastic.materials.size(), 0.0);
  for (std::size_t b = 0; b < stored_of_block.size(); ++b)
    stored_of_material[at(elastic.blocks.blocks[b].material)] += stored_of_block[b];
  double stored = 0.0, lost_before = 0.0, lost_after = 0.0;
  for (std::size_t m = 0; m < stored_of_material.size(); ++m) {
    const double decay = elastic.materials[m].branch.half_step_decay(dt), kept = decay * decay;
    stored += stored_of_material[m];
    lost_before += (1.0 / kept - 1.0) * stored_of_material[m];
    lost_after += (1.0 - kept) * stored_of_material[m];
  }
  BranchState& branch = elastic.branch;
  branch.dissipated += branch.pending + lost_before;
  branch.pending = lost_after;
  branch.stored = stored;
  branch.dt = dt;
}

}  // namespace

ElasticForce make_elastic_force(const Topology& topology, std::span<const Vec3> reference_positions,
                                std::span<const Material> materials, std::span<const Index> material_of_tet) {
  ElasticForce elastic;
  elastic.materials.assign(materials.begin(), materials.end());
  elastic.blocks = make_element_blocks(topology, material_of_tet);
  elastic.groups.resize(at(elastic.blocks.num_groups));
  const auto has_branch = [](const Material& material) { return material.branch.is_active(); };
  if (std::any_of(materials.begin(), materials.end(), has_branch))
    elastic.branch.groups.resize(at(elastic.blocks.num_groups));
  elastic.stress.resize(at(topology.num_tets()));
  elastic.stress_bound.resize(at(topology.num_tets()));
  elastic.interface_forces.resize(at(elastic.blocks.num_slots));
  for (const ElementBlock& block : elastic.blocks.blocks) {
    fill_groups(elastic, topology, reference_positions, block);
    relax_fully(elastic, topology, reference_positions, block);
  }
  return elastic;
}

void refresh_elastic_force(ElasticForce& elastic, const Topology& topology, std::span<const Index> changed_tets) {
  refresh_blocks(elastic.blocks, topology, changed_tets);
  elastic.interface_forces.resize(at(elastic.blocks.num_slots));
}

void update_elastic_forces(ElasticForce& elastic, std::span<const Vec4> x, std::span<Vec4> f, double dt) {
  const auto k = coefficients(elastic, dt);
  double* slots = elastic.interface_forces.empty() ? nullptr : elastic.interface_forces.data()->data();
  const std::vector<ElementBlock>& blocks = elastic.blocks.blocks;
  std::vector<double> stored(blocks.size());
  parallel_blocks(to_index(blocks.size()), [&](Index b) {
    stored[at(b)] = add_block_forces(view(elastic, b, x), k[at(blocks[at(b)].material)], f.data()->data(), slots);
  });
  sum_interface(elastic, f);
  if (branch_groups(elastic)) book_branch(elastic, dt, stored);
}

BulkState bulk_state(const ElasticForce& elastic, std::span<const Vec4> x) {
  const auto k = coefficients(elastic, elastic.branch.dt);
  const std::vector<ElementBlock>& blocks = elastic.blocks.blocks;
  return ordered_sum<BulkState>(
      to_index(blocks.size()), [&](Index b) { return block_state(view(elastic, b, x), k[at(blocks[at(b)].material)]); },
      1);
}

double strain_energy(const ElasticForce& elastic, std::span<const Vec4> x) {
  return bulk_state(elastic, x).strain_energy;
}

void update_stress(ElasticForce& elastic, std::span<const Vec4> x) {
  const auto k = coefficients(elastic, elastic.branch.dt);
  const std::vector<ElementBlock>& blocks = elastic.blocks.blocks;
  parallel_blocks(to_index(blocks.size()), [&](Index b) {
    store_block_stress(view(elastic, b, x), k[at(blocks[at(b)].material)], elastic.stress.data(),
                       elastic.stress_bound.data());
  });
}

}  // namespace knap
