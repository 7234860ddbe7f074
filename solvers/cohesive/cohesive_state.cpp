#include "cohesive/cohesive_state.hpp"

namespace knap {
namespace {

void list_vertices(CrackState& cracks) {
  cracks.vertices.clear();
  for (Index v = 0; v + 1 < to_index(cracks.record_offsets.size()); ++v)
    if (cracks.record_offsets[at(v)] != cracks.record_offsets[at(v) + 1]) cracks.vertices.push_back(v);
}

}  // namespace

CrackState make_crack_state(const Topology& topology) {
  CrackState cracks;
  cracks.face_of_facet.assign(at(topology.num_facets()), none);
  cracks.record_offsets.assign(at(topology.num_vertices()) + 1, 0);
  cracks.losses_of_vertex.resize(at(topology.num_vertices()));
  cracks.step_losses_of_vertex.resize(at(topology.num_vertices()));
  return cracks;
}

void add_cracks(CrackState& cracks, std::span<const CrackFace> faces, std::span<const VertexRecord> records) {
  std::vector<CrackFace> merged_faces;
  merged_faces.reserve(cracks.faces.size() + faces.size());
  std::vector<Index> slot_of_old(cracks.faces.size()), slot_of_new(faces.size());
  for (std::size_t i = 0, j = 0; i < cracks.faces.size() || j < faces.size();) {
    const bool take_old = j == faces.size() || (i < cracks.faces.size() && cracks.faces[i].facet < faces[j].facet);
    (take_old ? slot_of_old[i] : slot_of_new[j]) = to_index(merged_faces.size());
    merged_faces.push_back(take_old ? cracks.faces[i++] : faces[j++]);
    cracks.face_of_facet[at(merged_faces.back().facet)] = to_index(merged_faces.size()) - 1;
  }
  std::vector<CrackRecord> merged;
  merged.reserve(cracks.records.size() + records.size());
  auto added = records.begin();
  for (Index v = 0; v + 1 < to_index(cracks.record_offsets.size()); ++v) {
    const auto old = cracks.records_of_vertex(v);
    cracks.record_offsets[at(v)] = to_index(merged.size());
    for (CrackRecord record : old) {
      record.face = slot_of_old[at(record.face)];
      merged.push_back(record);
    }
    for (; added != records.end() && added->vertex == v; ++added) {
      merged.push_back(added->record);
      merged.back().face = slot_of_new[at(added->record.face)];
    }
  }
  cracks.record_offsets.back() = to_index(merged.size());
  cracks.faces.swap(merged_faces);
  cracks.records.swap(merged);
  list_vertices(cracks);
}

void drop_ended_faces(CrackState& cracks) {
  if (std::none_of(cracks.faces.begin(), cracks.faces.end(), [](const CrackFace& face) { return face.has_ended(); }))
    return;
  std::vector<Index> new_slot(cracks.faces.size(), none);
  Index kept_faces = 0;
  for (std::size_t slot = 0; slot < cracks.faces.size(); ++slot) {
    const CrackFace face = cracks.faces[slot];
    if (face.has_ended()) {
      cracks.face_of_facet[at(face.facet)] = none;
      continue;
    }
    new_slot[slot] = kept_faces;
    cracks.face_of_facet[at(face.facet)] = kept_faces;
    cracks.faces[at(kept_faces++)] = face;
  }
  cracks.faces.resize(at(kept_faces));
  Index kept = 0;
  Index next = cracks.record_offsets[0];
  for (Index v = 0; v + 1 < to_index(cracks.record_offsets.size()); ++v) {
    const Index end = cracks.record_offsets[at(v) + 1];
    cracks.record_offsets[at(v)] = kept;
    for (; next < end; ++next) {
      CrackRecord record = cracks.records[at(next)];
      record.face = new_slot[at(record.face)];
      if (record.face != none) cracks.records[at(kept++)] = record;
    }
  }
  cracks.record_offsets.back() = kept;
  cracks.records.resize(at(kept));
  list_vertices(cracks);
  group_records(cracks);
}

}  // namespace knap
