#include "cohesive/hand_over.hpp"

#include <algorithm>
#include <limits>

namespace knap {
namespace {

bool has_parted(const CrackFace& face, std::span<const Vec4> x, bool one_fragment, const HandOverOptions& options) {
  const double size = options.facet_size[at(face.facet)];
  double smallest = std::numeric_limits<double>::max(), largest = 0.0;
  for (const auto& [a, b] : face.nodes) {
    const double jump = (xyz(x[at(b)]) - xyz(x[at(a)])).norm();
    smallest = std::min(smallest, jump);
    largest = std::max(largest, jump);
  }
  if (one_fragment) return smallest > options.jump_within * size;
  return smallest > options.jump_everywhere * size || largest > options.jump_somewhere * size;
}

}  // namespace

Index hand_over_faces(CrackState& cracks, Topology& topology, std::span<const Vec4> x,
                      std::span<const Index> fragment_of_tet, const HandOverOptions& options) {
  Index count = 0;
  for (CrackFace& face : cracks.faces) {
    if (topology.facet_state[at(face.facet)] != FacetState::Failed) continue;
    const auto& [minus, plus] = topology.facet_tets[at(face.facet)];
    const bool one_fragment = fragment_of_tet[at(minus)] == fragment_of_tet[at(plus)];
    if (!has_parted(face, x, one_fragment, options)) continue;
    topology.facet_state[at(face.facet)] = FacetState::HandedOver;
    face.normal[3] = face.rotates() ? face_action::ends_and_rotates : face_action::ends;
    ++count;
  }
  return count;
}

std::vector<std::uint8_t> vertices_with_records(const CrackState& cracks) {
  std::vector<std::uint8_t> has_records(cracks.losses_of_vertex.size(), 0);
  for (const Index vertex : cracks.vertices)
    for (const CrackRecord& record : cracks.records_of_vertex(vertex))
      if (!cracks.faces[at(record.face)].has_ended()) has_records[at(vertex)] = 1;
  return has_records;
}

}  // namespace knap
