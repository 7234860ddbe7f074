// What the vertex kernels will need next, asked for ahead; included once for every instruction set.
#if defined(KNAP_COHESIVE_ASK_AHEAD_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef KNAP_COHESIVE_ASK_AHEAD_INL_HPP
#undef KNAP_COHESIVE_ASK_AHEAD_INL_HPP
#else
#define KNAP_COHESIVE_ASK_AHEAD_INL_HPP
#endif

#include <hwy/highway.h>

#include <cstddef>

#include "cohesive/vertex_kernel.hpp"

HWY_BEFORE_NAMESPACE();
namespace knap {
namespace HWY_NAMESPACE {

inline constexpr Index rows_per_face = sizeof(CrackFace) / sizeof(Vec4);
inline constexpr Index rotation_row = offsetof(CrackFace, rotation) / sizeof(Vec4);

// Records, faces and nodes of a group lie anywhere in memory: asked for ahead, they come while the group before is
// solved, into the second-level cache, for the first holds the local rows. Where there are none the address is of no
// use, which does not harm.
HWY_INLINE void prefetch(const void* address) { __builtin_prefetch(address, 0, 2); }
HWY_INLINE void prefetch_to_write(const void* address) { __builtin_prefetch(address, 1, 2); }

HWY_INLINE void prefetch_nodes(const ImpulseView& view, const PerLane<Index>& nodes) {
  for (const Index node : nodes) {
    const std::ptrdiff_t first = 4 * std::ptrdiff_t{node};
    prefetch_to_write(view.v + first);
    prefetch(view.x + first);
    prefetch(view.v_before + first);
    prefetch(view.mass + node);
  }
}
HWY_INLINE const Vec4* first_row_of_face(const ImpulseView& view, Index couple) {
  return reinterpret_cast<const Vec4*>(view.faces) + (couple & ~(rows_per_face - 1));
}
HWY_INLINE void prefetch_records(const ImpulseView& view, const RecordSlots& slots) {
  for (std::size_t lane = 0; lane < at(group_lanes); ++lane) {
    prefetch_to_write(view.records + slots.record[lane]);
    prefetch(first_row_of_face(view, slots.couple[lane]));
  }
}
// Once the first lines of the faces are there.
HWY_INLINE void prefetch_couples(const ImpulseView& view, const RecordSlots& slots) {
  for (std::size_t lane = 0; lane < at(group_lanes); ++lane) {
    const Index couple = slots.couple[lane];
    if (couple == none) continue;
    prefetch_to_write(reinterpret_cast<const Vec4*>(view.faces) + couple);
    const Vec4* face = first_row_of_face(view, couple);
    if ((*face)[3] != face_action::none) prefetch(face + rotation_row);
  }
}

/// The group to be solved next, to be asked for meanwhile; may be null.
struct NextGroup {
  const ImpulseView& view;
  const RecordGroup* group;

  HWY_INLINE void ask_for_nodes(Index i) const {
    if (group && i < group->num_nodes) prefetch_nodes(view, view.groups->nodes[at(group->first_nodes + i)]);
  }
  HWY_INLINE void ask_for_records(Index i) const {
    if (group && i < group->num_slots) prefetch_records(view, view.groups->slots[at(group->first_slots + i)]);
  }
  HWY_INLINE void ask_for_couples(Index i) const {
    if (group && i < group->num_slots) prefetch_couples(view, view.groups->slots[at(group->first_slots + i)]);
  }
};

HWY_INLINE void prefetch_records_of(const ImpulseView& view, Index vertex) {
  for (Index r = view.record_offsets[vertex]; r < view.record_offsets[vertex + 1]; ++r) prefetch(view.records + r);
}
HWY_INLINE void prefetch_surroundings_of(const ImpulseView& view, Index vertex) {
  for (Index r = view.record_offsets[vertex]; r < view.record_offsets[vertex + 1]; ++r) {
    const CrackRecord& record = view.records[r];
    prefetch(view.faces + record.face);
    for (const std::ptrdiff_t node : {record.node_a, record.node_b}) {
      prefetch(view.v + 4 * node);
      prefetch(view.v_before + 4 * node);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace knap
HWY_AFTER_NAMESPACE();
#endif
