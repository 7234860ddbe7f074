#pragma once
// The tets cut into blocks of consecutive ones of one material, the unit of work of the bulk sweeps. A block adds the
// forces of its tets to a buffer of its own nodes, in a fixed order; nodes of one block only are then written straight,
// those shared between blocks go to slots that are summed in the order of the blocks. So there are no atomics, no
// colours, and the same bits for any number of threads; the blocks depend on the mesh alone. (A force buffer per
// corner, gathered at the nodes, is as deterministic but moves 128 bytes more a tet.)
//
// Tets may sleep: their block leaves them out. A tet's block never changes, so that only blocks in which a tet has
// fallen asleep or woken are laid out anew, and the sums depend on which tets sleep, not on how that came about.
// (Filling blocks up from the next ones would keep them full, but lay out everything after the first change anew.)
#include <span>

#include "core/topology.hpp"

namespace knap {

inline constexpr Index lanes = 8;              ///< tets of a lane group, whatever the vector width
inline constexpr Index max_block_tets = 2048;  ///< bounds the local buffers of the kernels
inline constexpr Index max_block_nodes = 4 * max_block_tets;

inline constexpr Index node_stride = 8;  ///< doubles of a local node: padded position and force, one cache line

/// The corners of a tet as node_stride * local node.
using LocalCorners = std::array<std::uint16_t, 4>;

struct ElementBlock {
  Index material = 0;        ///< of all its tets
  std::vector<Index> tets;   ///< those that do not sleep, ascending
  Index num_tets = 0;        ///< of these
  Index first_tet = none;    ///< if they are consecutive: sweeps then need not read the list
  Index first_group = 0;     ///< of the arrays by lane group
  Index num_groups = 0;      ///< lane groups in use, the last one padded
  Index num_private = 0;     ///< nodes that no other block touches, listed first
  Index first_slot = 0;      ///< of its shared nodes in the array of interface slots
  std::vector<Index> nodes;  ///< the local nodes
};

/// A node whose force is summed over interface slots is listed in interface_nodes, together with those of no tet at
/// all.
struct ElementBlocks {
  std::vector<ElementBlock> blocks;
  std::vector<LocalCorners> corners;   ///< by group and lane; padding lanes have local node 0 four times
  std::vector<Index> block_of_tet;     ///< sleeping or not
  Index num_groups = 0;                ///< over all blocks, when no tet sleeps
  std::vector<Index> interface_nodes;  ///< nodes
  Csr slots_of_interface;              ///< per entry of interface_nodes its slots, by ascending block
  Index num_slots = 0;

  std::vector<Index> num_blocks_of_node;  ///< how many blocks touch a node
  std::vector<Index> row_of_node;         ///< scratch by node, all none between calls
};

/// Tets in a block: enough blocks to keep 16 threads busy on small meshes, few shared nodes on large ones.
Index block_size(Index num_tets);
/// Materials by tet, empty = one for all. Blocks are ordered by material, then by tet.
ElementBlocks make_element_blocks(const Topology& topology, std::span<const Index> material_of_tet = {});

/// Follows a change of tet_nodes of the given tets: new node lists for their blocks, new interface.
void refresh_blocks(ElementBlocks& blocks, const Topology& topology, std::span<const Index> changed_tets);
/// The same for whole blocks, by block 1 where nodes or tets have changed.
void refresh_marked_blocks(ElementBlocks& blocks, const Topology& topology, std::span<const std::uint8_t> changed);

/// Some tets, ascending, by block.
std::vector<std::vector<Index>> tets_by_block(const ElementBlocks& blocks, std::span<const Index> tets);
/// Gives a block other tets, ascending and of those it was made with; refresh_marked_blocks must follow.
void set_tets(ElementBlock& block, std::vector<Index> tets);

/// The tet in a lane of the k-th group of a block, or none for padding. Each lane walks its own eighth of the block:
/// neighbours in a vector then rarely share nodes, so their additions do not wait for each other.
inline Index tet_of_lane(const ElementBlock& block, Index group, Index lane) {
  const Index local = lane * block.num_groups + group;
  if (local >= block.num_tets) return none;
  return block.first_tet != none ? block.first_tet + local : block.tets[at(local)];
}

}  // namespace knap
