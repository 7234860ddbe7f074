#include "cohesive/hand_over.hpp"

#include <algorithm>

namespace knap {
namespace {

bool has_parted(const CrackFace& face, std::span<const Vec4> x, double size, const HandOverOptions& options) {
  double smallest = 1e300, largest = 0.0;
  for (const auto& [a, b] : face.nodes) {
    const double jump = (xyz(x[at(b)]) - xyz(x[at(a)])).norm();
    smallest = std::min(smallest, jump);
    largest = std::max(largest, jump);
  }
  return smallest > options.jump_everywhere * size || largest > options.jump_somewhere * size;
}

// Ends the records of a face; what they have spent stays with the vertex.
void end_records(CrackState& cracks, const Topology& topology, Index slot) {
  for (int k = 0; k < 3; ++k) {
    const Index vertex = topology.facet_vertex(cracks.faces[at(slot)].facet, k);
    auto& records = cracks.records_of_vertex[at(vertex)];
    const auto record =
        std::find_if(records.begin(), records.end(), [slot](const CrackRecord& r) { return r.face == slot; });
    cracks.losses_of_vertex[at(vertex)].cohesive += record->dissipated;
    cracks.losses_of_vertex[at(vertex)].cohesive_shear += record->dissipated_shear;
    records.erase(record);
  }
}

// Closes the gaps in the list of faces; the faces behind move up and their records follow.
void drop_ended_faces(CrackState& cracks, const Topology& topology) {
  Index kept = 0;
  for (Index slot = 0; slot < to_index(cracks.faces.size()); ++slot) {
    if (cracks.faces[at(slot)].facet == none) continue;
    if (kept != slot) {
      const CrackFace& face = cracks.faces[at(kept)] = cracks.faces[at(slot)];
      cracks.face_of_facet[at(face.facet)] = kept;
      for (int k = 0; k < 3; ++k)
        for (CrackRecord& record : cracks.records_of_vertex[at(topology.facet_vertex(face.facet, k))])
          if (record.face == slot) record.face = kept;
    }
    ++kept;
  }
  cracks.faces.resize(at(kept));
  std::erase_if(cracks.vertices, [&](Index vertex) { return cracks.records_of_vertex[at(vertex)].empty(); });
}

}  // namespace

Index hand_over_faces(CrackState& cracks, Topology& topology, std::span<const Vec4> x,
                      std::span<const Index> fragment_of_tet, const HandOverOptions& options) {
  Index count = 0;
  for (Index slot = 0; slot < to_index(cracks.faces.size()); ++slot) {
    CrackFace& face = cracks.faces[at(slot)];
    if (topology.facet_state[at(face.facet)] != FacetState::Failed) continue;
    const auto& [minus, plus] = topology.facet_tets[at(face.facet)];
    if (fragment_of_tet[at(minus)] == fragment_of_tet[at(plus)]) continue;
    if (!has_parted(face, x, options.facet_size[at(face.facet)], options)) continue;
    end_records(cracks, topology, slot);
    topology.facet_state[at(face.facet)] = FacetState::HandedOver;
    cracks.face_of_facet[at(face.facet)] = none;
    face.facet = none;
    ++count;
  }
  if (count > 0) drop_ended_faces(cracks, topology);
  return count;
}

std::vector<std::uint8_t> vertices_with_records(const CrackState& cracks) {
  std::vector<std::uint8_t> has_records(cracks.records_of_vertex.size(), 0);
  for (const Index vertex : cracks.vertices) has_records[at(vertex)] = 1;
  return has_records;
}

}  // namespace knap
