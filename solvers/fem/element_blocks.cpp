#include "fem/element_blocks.hpp"

#include <algorithm>

namespace knap {
namespace {

// Lists the distinct nodes of the block's tets in order of first touch; counts this block at each of them.
void list_nodes(ElementBlocks& blocks, ElementBlock& block, const Topology& topology) {
  for (const Index node : block.nodes) --blocks.num_blocks_of_node[at(node)];
  block.nodes.clear();
  for (const Index t : block.tets)
    for (const Index node : topology.tet_nodes[at(t)])
      if (blocks.row_of_node[at(node)] == none) {
        blocks.row_of_node[at(node)] = 0;
        block.nodes.push_back(node);
        ++blocks.num_blocks_of_node[at(node)];
      }
  for (const Index node : block.nodes) blocks.row_of_node[at(node)] = none;
}

// Puts the private nodes first and writes the corners of the block's tets as local numbers.
void number_nodes(ElementBlocks& blocks, ElementBlock& block, const Topology& topology) {
  const auto is_private = [&](Index node) { return blocks.num_blocks_of_node[at(node)] == 1; };
  const auto shared = std::stable_partition(block.nodes.begin(), block.nodes.end(), is_private);
  block.num_private = static_cast<Index>(shared - block.nodes.begin());
  for (std::size_t i = 0; i < block.nodes.size(); ++i) blocks.row_of_node[at(block.nodes[i])] = to_index(i);
  for (Index group = 0; group < block.num_groups; ++group)
    for (Index lane = 0; lane < lanes; ++lane) {
      const Index tet = tet_of_lane(block, group, lane);
      LocalCorners& corners = blocks.corners[at((block.first_group + group) * lanes + lane)];
      corners.fill(0);
      if (tet == none) continue;
      for (std::size_t i = 0; i < 4; ++i)
        corners[i] = static_cast<std::uint16_t>(node_stride * blocks.row_of_node[at(topology.tet_nodes[at(tet)][i])]);
    }
  for (const Index node : block.nodes) blocks.row_of_node[at(node)] = none;
}

bool has_shared_node_among_private(const ElementBlocks& blocks, const ElementBlock& block) {
  return std::any_of(block.nodes.begin(), block.nodes.begin() + block.num_private,
                     [&](Index node) { return blocks.num_blocks_of_node[at(node)] > 1; });
}

// Numbers the slots of all blocks in order and lists the nodes they belong to.
void list_interface(ElementBlocks& blocks, Index num_nodes) {
  blocks.interface_nodes.clear();
  blocks.num_slots = 0;
  std::vector<Index> row_of_slot;
  for (ElementBlock& block : blocks.blocks) {
    block.first_slot = blocks.num_slots;
    for (std::size_t i = at(block.num_private); i < block.nodes.size(); ++i) {
      Index& row = blocks.row_of_node[at(block.nodes[i])];
      if (row == none) {
        row = to_index(blocks.interface_nodes.size());
        blocks.interface_nodes.push_back(block.nodes[i]);
      }
      row_of_slot.push_back(row);
    }
    blocks.num_slots = to_index(row_of_slot.size());
  }
  for (const Index node : blocks.interface_nodes) blocks.row_of_node[at(node)] = none;
  for (Index node = 0; node < num_nodes; ++node)
    if (blocks.num_blocks_of_node[at(node)] == 0) blocks.interface_nodes.push_back(node);
  blocks.slots_of_interface = make_csr(to_index(blocks.interface_nodes.size()), row_of_slot);
}

// Blocks of the tets of one material.
void add_blocks(ElementBlocks& blocks, Index material, std::span<const Index> tets, Index size) {
  for (Index first = 0; first < to_index(tets.size()); first += size) {
    const auto own = tets.subspan(at(first), std::min(at(size), tets.size() - at(first)));
    ElementBlock block;
    block.material = material;
    set_tets(block, {own.begin(), own.end()});
    block.first_group = blocks.num_groups;
    blocks.num_groups += block.num_groups;
    for (const Index t : own) blocks.block_of_tet[at(t)] = to_index(blocks.blocks.size());
    blocks.blocks.push_back(std::move(block));
  }
}

}  // namespace

Index block_size(Index num_tets) {
  constexpr Index smallest = 256, wanted_blocks = 32;
  const Index size = std::clamp(num_tets / wanted_blocks, smallest, max_block_tets);
  return size / lanes * lanes;
}

void set_tets(ElementBlock& block, std::vector<Index> tets) {
  block.num_tets = to_index(tets.size());
  block.num_groups = (block.num_tets + lanes - 1) / lanes;
  const bool consecutive = !tets.empty() && tets.back() - tets.front() + 1 == block.num_tets;
  block.first_tet = consecutive ? tets.front() : none;
  block.tets = std::move(tets);
}

ElementBlocks make_element_blocks(const Topology& topology, std::span<const Index> material_of_tet) {
  const auto material = [&](Index t) { return material_of_tet.empty() ? 0 : material_of_tet[at(t)]; };
  std::vector<std::vector<Index>> tets_of_material(1);
  for (Index t = 0; t < topology.num_tets(); ++t) {
    if (material(t) >= to_index(tets_of_material.size())) tets_of_material.resize(at(material(t)) + 1);
    tets_of_material[at(material(t))].push_back(t);
  }
  ElementBlocks blocks;
  blocks.block_of_tet.resize(at(topology.num_tets()));
  for (std::size_t m = 0; m < tets_of_material.size(); ++m)
    add_blocks(blocks, to_index(m), tets_of_material[m], block_size(topology.num_tets()));
  blocks.corners.resize(at(blocks.num_groups * lanes));
  refresh_marked_blocks(blocks, topology, std::vector<std::uint8_t>(blocks.blocks.size(), 1));
  return blocks;
}

void refresh_blocks(ElementBlocks& blocks, const Topology& topology, std::span<const Index> changed_tets) {
  std::vector<std::uint8_t> changed(blocks.blocks.size(), 0);
  for (const Index tet : changed_tets) changed[at(blocks.block_of_tet[at(tet)])] = 1;
  refresh_marked_blocks(blocks, topology, changed);
}

void refresh_marked_blocks(ElementBlocks& blocks, const Topology& topology, std::span<const std::uint8_t> changed) {
  blocks.num_blocks_of_node.resize(at(topology.num_nodes()), 0);
  blocks.row_of_node.resize(at(topology.num_nodes()), none);
  for (std::size_t b = 0; b < changed.size(); ++b)
    if (changed[b]) list_nodes(blocks, blocks.blocks[b], topology);
  for (std::size_t b = 0; b < changed.size(); ++b)
    if (changed[b] || has_shared_node_among_private(blocks, blocks.blocks[b]))
      number_nodes(blocks, blocks.blocks[b], topology);
  list_interface(blocks, topology.num_nodes());
}

std::vector<std::vector<Index>> tets_by_block(const ElementBlocks& blocks, std::span<const Index> tets) {
  std::vector<std::vector<Index>> lists(blocks.blocks.size());
  for (const Index t : tets) lists[at(blocks.block_of_tet[at(t)])].push_back(t);
  return lists;
}

}  // namespace knap
