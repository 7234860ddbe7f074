#include "fem/element_blocks.hpp"

#include <algorithm>

namespace knap {
namespace {

// Lists the distinct nodes of the block's tets in order of first touch; counts this block at each of them.
void list_nodes(ElementBlocks& blocks, ElementBlock& block, const Topology& topology) {
  for (const Index node : block.nodes) --blocks.num_blocks_of_node[at(node)];
  block.nodes.clear();
  for (Index t = block.first_tet; t < block.first_tet + block.num_tets; ++t)
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

void rebuild(ElementBlocks& blocks, const Topology& topology, std::vector<char>& touched) {
  blocks.num_blocks_of_node.resize(at(topology.num_nodes()), 0);
  blocks.row_of_node.resize(at(topology.num_nodes()), none);
  for (std::size_t b = 0; b < touched.size(); ++b)
    if (touched[b]) list_nodes(blocks, blocks.blocks[b], topology);
  for (std::size_t b = 0; b < touched.size(); ++b)
    if (touched[b] || has_shared_node_among_private(blocks, blocks.blocks[b]))
      number_nodes(blocks, blocks.blocks[b], topology);
  list_interface(blocks, topology.num_nodes());
}

}  // namespace

Index block_size(Index num_tets) {
  constexpr Index smallest = 256, wanted_blocks = 32;
  const Index size = std::clamp(num_tets / wanted_blocks, smallest, max_block_tets);
  return size / lanes * lanes;
}

ElementBlocks make_element_blocks(const Topology& topology) {
  ElementBlocks blocks;
  const Index size = block_size(topology.num_tets());
  for (Index first = 0; first < topology.num_tets(); first += size) {
    ElementBlock block;
    block.first_tet = first;
    block.num_tets = std::min(size, topology.num_tets() - first);
    block.first_group = blocks.num_groups;
    block.num_groups = (block.num_tets + lanes - 1) / lanes;
    blocks.num_groups += block.num_groups;
    blocks.blocks.push_back(std::move(block));
  }
  blocks.corners.resize(at(blocks.num_groups * lanes));
  std::vector<char> touched(blocks.blocks.size(), 1);
  rebuild(blocks, topology, touched);
  return blocks;
}

void refresh_blocks(ElementBlocks& blocks, const Topology& topology, std::span<const Index> changed_tets) {
  std::vector<char> touched(blocks.blocks.size(), 0);
  for (const Index tet : changed_tets) touched[at(block_of_tet(blocks, tet))] = 1;
  rebuild(blocks, topology, touched);
}

}  // namespace knap
