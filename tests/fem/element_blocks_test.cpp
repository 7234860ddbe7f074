#include "fem/element_blocks.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/fem/grid_mesh.hpp"

namespace knap {
namespace {

// Every tet sits in one lane, with its nodes; private and shared nodes are what they are called; slots are complete.
void expect_consistent(const ElementBlocks& blocks, const Topology& topology) {
  std::vector<std::set<Index>> blocks_of_node(at(topology.num_nodes()));
  std::vector<int> seen(at(topology.num_tets()), 0);
  for (std::size_t b = 0; b < blocks.blocks.size(); ++b) {
    const ElementBlock& block = blocks.blocks[b];
    ASSERT_LE(to_index(block.nodes.size()), max_block_nodes);
    for (Index g = 0; g < block.num_groups; ++g)
      for (Index lane = 0; lane < lanes; ++lane) {
        const Index tet = tet_of_lane(block, g, lane);
        const LocalCorners& corners = blocks.corners[at((block.first_group + g) * lanes + lane)];
        if (tet == none) continue;
        ++seen[at(tet)];
        EXPECT_EQ(blocks.block_of_tet[at(tet)], to_index(b));
        for (std::size_t i = 0; i < 4; ++i) {
          ASSERT_EQ(block.nodes[corners[i] / node_stride], topology.tet_nodes[at(tet)][i]);
          blocks_of_node[at(topology.tet_nodes[at(tet)][i])].insert(to_index(b));
        }
      }
  }
  for (const int count : seen) EXPECT_EQ(count, 1);
  std::vector<std::size_t> slots_of_node(at(topology.num_nodes()), 0);
  for (Index i = 0; i < to_index(blocks.interface_nodes.size()); ++i)
    slots_of_node[at(blocks.interface_nodes[at(i)])] = blocks.slots_of_interface[i].size();
  for (const ElementBlock& block : blocks.blocks)
    for (Index i = 0; i < to_index(block.nodes.size()); ++i) {
      const auto& touching = blocks_of_node[at(block.nodes[at(i)])];
      if (i < block.num_private)
        EXPECT_EQ(touching.size(), 1u);
      else
        EXPECT_EQ(slots_of_node[at(block.nodes[at(i)])], touching.size());
    }
}

TEST(ElementBlocks, CoverTheMeshOnce) {
  for (const Index n : {1, 2, 5, 9, 16}) {
    const Topology topology = make_topology(grid_mesh(n, 1.0, 0.1));
    expect_consistent(make_element_blocks(topology), topology);
  }
}

TEST(ElementBlocks, FollowSplits) {
  Topology topology = make_topology(grid_mesh(9, 1.0, 0.1));
  ElementBlocks blocks = make_element_blocks(topology);
  for (const Index stride : {50, 7, 3}) {
    std::vector<Index> changed;
    for (Index t = stride; t < topology.num_tets(); t += stride) {
      topology.vertex_of_node.push_back(topology.tet_vertices[at(t)][1]);
      topology.tet_nodes[at(t)][1] = topology.num_nodes() - 1;
      changed.push_back(t);
    }
    refresh_blocks(blocks, topology, changed);
    expect_consistent(blocks, topology);
  }
}

TEST(ElementBlocks, SizeFitsTheLocalBuffers) {
  for (const Index n : {1, 8, 1000, 46000, 140000, 2000000}) {
    EXPECT_LE(block_size(n), max_block_tets);
    EXPECT_EQ(block_size(n) % lanes, 0);
  }
}

}  // namespace
}  // namespace knap
