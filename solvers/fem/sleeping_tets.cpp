#include "fem/sleeping_tets.hpp"

#include <algorithm>
#include <limits>

#include "core/parallel.hpp"
#include "fem/element_lanes.hpp"

namespace knap {
namespace {

// No facet of a sleeping tet can then be overloaded, whatever stress its neighbour has.
constexpr float bound_asleep = -std::numeric_limits<float>::infinity();

void put_to_sleep(ElasticForce& elastic, std::span<const Index> before, std::span<const Index> after) {
  std::vector<Index> asleep;
  std::set_difference(before.begin(), before.end(), after.begin(), after.end(), std::back_inserter(asleep));
  for (const Index t : asleep) {
    elastic.stress[at(t)] = {};
    elastic.stress_bound[at(t)] = bound_asleep;
  }
}

}  // namespace

void set_active_tets(ElasticForce& elastic, const Topology& topology, std::span<const Vec3> reference_positions,
                     std::span<const Index> active) {
  auto wanted = tets_by_block(elastic.blocks, active);
  std::vector<std::uint8_t> changed(wanted.size(), 0);
  auto& remembered = elastic.branch.remembered;
  if (!elastic.branch.groups.empty()) remembered.resize(at(topology.num_tets()));
  parallel_blocks(to_index(wanted.size()), [&](Index b) {
    ElementBlock& block = elastic.blocks.blocks[at(b)];
    if (wanted[at(b)] == block.tets) return;
    put_to_sleep(elastic, block.tets, wanted[at(b)]);
    read_branch(elastic, block, remembered);
    set_tets(block, std::move(wanted[at(b)]));
    fill_groups(elastic, topology, reference_positions, block);
    write_branch(elastic, block, remembered);
    changed[at(b)] = 1;
  });
  refresh_marked_blocks(elastic.blocks, topology, changed);
  elastic.interface_forces.resize(at(elastic.blocks.num_slots));
}

void relax_sleeping(ElasticForce& elastic, const Topology& topology, std::span<const Index> tets,
                    std::span<const Vec4> x) {
  if (elastic.branch.groups.empty()) return;
  for (const Index t : tets) {
    const TetCorners& nodes = topology.tet_nodes[at(t)];
    const Vec3 origin = xyz(x[at(nodes[0])]);
    const Vec3 a = xyz(x[at(nodes[1])]) - origin, b = xyz(x[at(nodes[2])]) - origin, c = xyz(x[at(nodes[3])]) - origin;
    elastic.branch.remembered[at(t)] = {a.dot(a), b.dot(b), c.dot(c), b.dot(c), c.dot(a), a.dot(b)};
  }
}

std::vector<Index> sleeping_tets(const ElasticForce& elastic) {
  std::vector<std::uint8_t> is_active(elastic.blocks.block_of_tet.size(), 0);
  for (const ElementBlock& block : elastic.blocks.blocks)
    for (const Index t : block.tets) is_active[at(t)] = 1;
  std::vector<Index> asleep;
  for (std::size_t t = 0; t < is_active.size(); ++t)
    if (!is_active[t]) asleep.push_back(to_index(t));
  return asleep;
}

std::vector<std::array<double, 6>> relaxed_metrics(const ElasticForce& elastic) {
  if (elastic.branch.groups.empty()) return {};
  auto metrics = elastic.branch.remembered;
  metrics.resize(elastic.blocks.block_of_tet.size());
  for (const ElementBlock& block : elastic.blocks.blocks) read_branch(elastic, block, metrics);
  return metrics;
}

void set_relaxed_metrics(ElasticForce& elastic, std::span<const std::array<double, 6>> metric_of_tet) {
  if (elastic.branch.groups.empty()) return;
  elastic.branch.remembered.assign(metric_of_tet.begin(), metric_of_tet.end());
  for (const ElementBlock& block : elastic.blocks.blocks) write_branch(elastic, block, metric_of_tet);
}

}  // namespace knap
