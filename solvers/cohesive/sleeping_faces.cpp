#include "cohesive/sleeping_faces.hpp"

namespace knap {

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
