#include "cohesive/cohesive_state.hpp"

#include <algorithm>

namespace knap {
namespace {

void list_vertices(CrackState& cracks) {
  cracks.vertices.clear();
  for (Index v = 0; v + 1 < to_index(cracks.record_offsets.size()); ++v)
    if (cracks.record_offsets[at(v)] != cracks.record_offsets[at(v) + 1]) cracks.vertices.push_back(v);
}

std::vector<Index> facets(const CrackState& cracks) {
  std::vector<Index> all;
  all.reserve(cracks.faces.size());
  for (const CrackFace& face : cracks.faces) all.push_back(face.facet);
  return all;
}

// Removes the records of facets that have no face any more; the others follow their faces.
void keep_records_with_faces(CrackState& cracks, std::span<const Index> facet_of_old_slot) {
  Index kept = 0;
  Index next = cracks.record_offsets[0];
  for (Index v = 0; v + 1 < to_index(cracks.record_offsets.size()); ++v) {
    const Index end = cracks.record_offsets[at(v) + 1];
    cracks.record_offsets[at(v)] = kept;
    for (; next < end; ++next) {
      CrackRecord record = cracks.records[at(next)];
      record.face = cracks.face_of_facet[at(facet_of_old_slot[at(record.face)])];
      if (record.face != none) cracks.records[at(kept++)] = record;
    }
  }
  cracks.record_offsets.back() = kept;
  cracks.records.resize(at(kept));
}

}  // namespace

CrackState make_crack_state(const Topology& topology, std::vector<Index> first_vertices) {
  CrackState cracks;
  cracks.first_vertices = std::move(first_vertices);
  cracks.face_of_facet.assign(at(topology.num_facets()), none);
  cracks.record_offsets.assign(at(topology.num_vertices()) + 1, 0);
  cracks.losses_of_vertex.resize(at(topology.num_vertices()));
  cracks.step_losses_of_vertex.resize(at(topology.num_vertices()));
  return cracks;
}

void add_cracks(CrackState& cracks, std::span<const CrackFace> faces, std::span<const VertexRecord> records) {
  const Index first_face = to_index(cracks.faces.size());
  make_room(cracks.faces, cracks.faces.size() + faces.size());
  for (const CrackFace& face : faces) {
    cracks.face_of_facet[at(face.facet)] = to_index(cracks.faces.size());
    cracks.faces.push_back(face);
  }
  // From the back, so that every record moves at most once and only by the number of those added before it.
  auto from = cracks.records.end() - cracks.records.begin();
  make_room(cracks.records, cracks.records.size() + records.size());
  cracks.records.resize(cracks.records.size() + records.size());
  auto to = to_index(cracks.records.size());
  auto added = records.rbegin();
  for (Index v = to_index(cracks.record_offsets.size()) - 2; v >= 0 && added != records.rend(); --v) {
    const auto begin = cracks.record_offsets[at(v)];
    cracks.record_offsets[at(v + 1)] = to;
    for (; added != records.rend() && added->vertex == v; ++added) {
      CrackRecord& record = cracks.records[at(--to)];
      record = added->record;
      record.face += first_face;
    }
    while (from > begin) cracks.records[at(--to)] = cracks.records[static_cast<std::size_t>(--from)];
  }
  list_vertices(cracks);
  if (cracks.any_sleeps) list_awake_faces(cracks);
}

void list_awake_faces(CrackState& cracks) {
  cracks.any_sleeps =
      std::any_of(cracks.faces.begin(), cracks.faces.end(), [](const CrackFace& face) { return face.sleeps != 0; });
  cracks.awake_faces.clear();
  if (!cracks.any_sleeps) return;
  for (std::size_t slot = 0; slot < cracks.faces.size(); ++slot)
    if (!cracks.faces[slot].sleeps) cracks.awake_faces.push_back(to_index(slot));
}

void tidy_faces(CrackState& cracks) {
  const auto by_facet = [](const CrackFace& a, const CrackFace& b) { return a.facet < b.facet; };
  const auto ended = [](const CrackFace& face) { return face.has_ended(); };
  if (std::none_of(cracks.faces.begin(), cracks.faces.end(), ended) &&
      std::is_sorted(cracks.faces.begin(), cracks.faces.end(), by_facet))
    return;
  const std::vector<Index> facet_of_old_slot = facets(cracks);
  for (const Index facet : facet_of_old_slot) cracks.face_of_facet[at(facet)] = none;
  std::erase_if(cracks.faces, ended);
  std::sort(cracks.faces.begin(), cracks.faces.end(), by_facet);
  for (std::size_t slot = 0; slot < cracks.faces.size(); ++slot)
    cracks.face_of_facet[at(cracks.faces[slot].facet)] = to_index(slot);
  keep_records_with_faces(cracks, facet_of_old_slot);
  list_vertices(cracks);
  if (cracks.any_sleeps) list_awake_faces(cracks);
  group_records(cracks);
}

}  // namespace knap
