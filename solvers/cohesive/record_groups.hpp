#pragma once
// The vector kernels solve eight vertices at a time, one in each lane, record by record. So that lanes do not idle,
// vertices near each other in memory are grouped by their number of records; all of a group have the same law. A
// vertex's own result does not depend on its group.
#include <span>

#include "core/types.hpp"

namespace knap {

inline constexpr Index group_lanes = 8;
template <class T>
using PerLane = std::array<T, std::size_t{group_lanes}>;

/// The k-th records of a group; none in lanes with fewer records.
struct RecordSlots {
  PerLane<Index> record{};     ///< in CrackState::records
  PerLane<Index> couple{};     ///< its row of four doubles, counted from CrackState::faces
  PerLane<std::uint16_t> a{};  ///< local numbers of its nodes
  PerLane<std::uint16_t> b{};
};

/// Eight vertices with about as many records each.
struct RecordGroup {
  PerLane<Index> vertex{};  ///< none in lanes without one
  Index law = 0;            ///< of all of them, see law_of_vertex
  Index first_slots = 0;    ///< in RecordGroups::slots
  Index num_slots = 0;      ///< largest number of records of one of the vertices
  Index first_nodes = 0;    ///< in RecordGroups::nodes
  Index num_nodes = 0;      ///< largest number of nodes of one of the vertices
};

/// Derived from the records whenever these are added, removed or get other nodes.
struct RecordGroups {
  std::vector<RecordGroup> groups;
  std::vector<RecordSlots> slots;     ///< by group and number of the record at its vertex
  std::vector<PerLane<Index>> nodes;  ///< by group and local number, none where a vertex has fewer
  Index max_slots = 0;                ///< of a group
  Index max_nodes = 0;                ///< of a group
};

struct CrackState;
/// Numbers the nodes of every vertex (CrackRecord::local_a, local_b) and forms the groups of the records that do not
/// sleep. Between two steps: losses of this step that are not settled are lost where all records sleep.
void group_records(CrackState& cracks);

/// Vertices, those of one law together, cut where the law changes and into parts of at most so many.
std::vector<std::span<const Index>> parts_of_one_law(const CrackState& cracks, std::span<const Index> vertices,
                                                     Index largest);

}  // namespace knap
