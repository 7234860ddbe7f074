#include "cohesive/sleeping_faces.hpp"

#include <algorithm>

#include "cohesive/crack_faces.hpp"

namespace knap {

std::vector<Index> inner_faces(const CrackState& cracks, const Topology& topology, std::span<const Index> tets) {
  const auto has = [&tets](Index tet) { return std::binary_search(tets.begin(), tets.end(), tet); };
  std::vector<Index> slots;
  for (const Index tet : tets)
    for (const Index facet : topology.tet_facets[at(tet)]) {
      const Index slot = facet == none ? none : cracks.face_of_facet[at(facet)];
      if (slot == none || topology.facet_tets[at(facet)][0] != tet) continue;  // each facet once
      if (has(topology.facet_tets[at(facet)][1])) slots.push_back(slot);
    }
  return slots;
}

Vec3 take_pending_couples(CrackState& cracks, std::span<const Index> slots) {
  Vec3 pending = Vec3::Zero();
  for (const Index slot : slots) {
    CrackFace& face = cracks.faces[at(slot)];
    pending += pending_couple(face);
    face.couple.fill(Vec4::Zero());
    face.carried_couple = Vec3::Zero();
  }
  return pending;
}

void turn_impulses(CrackState& cracks, const Topology& topology, std::span<const Index> slots, const Mat3& rotation) {
  for (const Index slot : slots)
    for (int k = 0; k < 3; ++k)
      for (CrackRecord& record : cracks.records_of_vertex(topology.facet_vertex(cracks.faces[at(slot)].facet, k)))
        if (record.face == slot) record.impulse = rotation * record.impulse;
}

void set_sleeping_faces(CrackState& cracks, const Topology& topology, std::span<const Index> body_of_tet) {
  for (CrackFace& face : cracks.faces) {
    const auto& [minus, plus] = topology.facet_tets[at(face.facet)];
    const Index body = body_of_tet[at(minus)];
    face.sleeps = body != none && body == body_of_tet[at(plus)] ? 1 : 0;
    if (face.sleeps && !face.has_ended()) face.normal[3] = face_action::none;
  }
  list_awake_faces(cracks);
  group_records(cracks);
}

}  // namespace knap
