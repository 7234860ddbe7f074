#pragma once
// The tets cut into blocks of consecutive ones, the unit of work of the bulk sweeps. A block adds the forces of its
// tets to a buffer of its own nodes, in a fixed order; nodes of one block only are then written straight, those shared
// between blocks go to slots that are summed in the order of the blocks. So there are no atomics, no colours, and the
// same bits for any number of threads; the blocks depend on the mesh alone. (A force buffer per corner, gathered at the
// nodes, is as deterministic but moves 128 bytes more a tet.)
#include "core/topology.hpp"

namespace knap {

inline constexpr Index lanes = 8;              ///< tets of a lane group, whatever the vector width
inline constexpr Index max_block_tets = 2048;  ///< bounds the local buffers of the kernels
inline constexpr Index max_block_nodes = 4 * max_block_tets;

inline constexpr Index node_stride = 8;  ///< doubles of a local node: padded position and force, one cache line

/// The corners of a tet as node_stride * local node.
using LocalCorners = std::array<std::uint16_t, 4>;

struct ElementBlock {
  Index first_tet = 0;
  Index num_tets = 0;
  Index first_group = 0;     ///< of the arrays by lane group
  Index num_groups = 0;      ///< lane groups, the last one padded
  Index num_private = 0;     ///< nodes that no other block touches, listed first
  Index first_slot = 0;      ///< of its shared nodes in the array of interface slots
  std::vector<Index> nodes;  ///< the local nodes
};

/// A node whose force is summed over interface slots is listed in interface_nodes, together with those of no tet at
/// all.
struct ElementBlocks {
  std::vector<ElementBlock> blocks;
  std::vector<LocalCorners> corners;   ///< by group and lane; padding lanes have local node 0 four times
  Index num_groups = 0;                ///< over all blocks
  std::vector<Index> interface_nodes;  ///< nodes
  Csr slots_of_interface;              ///< per entry of interface_nodes its slots, by ascending block
  Index num_slots = 0;

  std::vector<Index> num_blocks_of_node;  ///< how many blocks touch a node
  std::vector<Index> row_of_node;         ///< scratch by node, all none between calls
};

/// Tets in a block: enough blocks to keep 16 threads busy on small meshes, few shared nodes on large ones.
Index block_size(Index num_tets);
ElementBlocks make_element_blocks(const Topology& topology);

/// Follows a change of tet_nodes of the given tets: new node lists for their blocks, new interface.
void refresh_blocks(ElementBlocks& blocks, const Topology& topology, std::span<const Index> changed_tets);

/// The tet in a lane of the k-th group of a block, or none for padding. Each lane walks its own eighth of the block:
/// neighbours in a vector then rarely share nodes, so their additions do not wait for each other.
inline Index tet_of_lane(const ElementBlock& block, Index group, Index lane) {
  const Index local = lane * block.num_groups + group;
  return local < block.num_tets ? block.first_tet + local : none;
}

/// The block that holds a tet.
inline Index block_of_tet(const ElementBlocks& blocks, Index tet) { return tet / blocks.blocks.front().num_tets; }

}  // namespace knap
