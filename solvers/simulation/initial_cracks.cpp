#include "simulation/initial_cracks.hpp"

#include <cassert>

#include "cohesive/fragments.hpp"
#include "cohesive/insertion.hpp"
#include "simulation/make_simulation.hpp"
#include "simulation/mass_scaling.hpp"

namespace knap {
namespace {

std::vector<OverloadedFacet> facets_of(std::span<const InitialCrack> cracks) {
  std::vector<OverloadedFacet> facets;
  for (const InitialCrack& crack : cracks) {
    assert(facets.empty() || facets.back().facet < crack.facet);
    facets.push_back({.facet = crack.facet, .effective = crack.strength});
  }
  return facets;
}

// Records that have not failed begin as virgin ones: those damaged enough for it soften from the first step on, and
// that books nothing while they are closed.
void damage_records(CrackState& cracks, Topology& topology, std::span<const InitialCrack> initial) {
  std::vector<const InitialCrack*> of_face(cracks.faces.size(), nullptr);
  for (const InitialCrack& crack : initial) of_face[at(cracks.face_of_facet[at(crack.facet)])] = &crack;
  for (CrackRecord& record : cracks.records) {
    const double damage = of_face[at(record.face)]->damage[record.corner];
    record.impulse.setZero();
    record.d_max = damage * record.delta_c;
    if (damage < 1.0) continue;
    record.regime = RecordRegime::Failed;
    cracks.faces[at(record.face)].failed[record.corner] = 1;
  }
  for (const CrackFace& face : cracks.faces)
    if (face.failed[0] && face.failed[1] && face.failed[2]) topology.facet_state[at(face.facet)] = FacetState::Failed;
}

}  // namespace

void open_initial_cracks(Simulation& s, std::span<const InitialCrack> cracks) {
  assert(s.clock.step == 0 && s.cracks.records.empty());
  if (cracks.empty()) return;
  update_stress(s.elastic, s.nodes.x);
  const auto change = insert_cracks(s.cracks, s.topology, s.nodes, facets_of(cracks),
                                    {.dt = s.clock.dt,
                                     .fracture_energy = s.reference.fracture_energy,
                                     .facet_area = s.reference.facet_area,
                                     .corner_mass = s.reference.corner_mass,
                                     .stress = s.elastic.stress});
  damage_records(s.cracks, s.topology, cracks);
  refresh_elastic_force(s.elastic, s.topology, change.changed_tets);
  update_elastic_forces(s.elastic, s.nodes.x, s.nodes.f, 0.0);
  scale_masses(s, change.split_vertices);
  const double added_mass = s.totals.added_mass;
  s.totals = {};
  s.totals.added_mass = added_mass;
  s.totals.inserted_facets = to_index(cracks.size());
  s.contact.fragment_of_tet = fragment_labels(s.topology, s.cracks, FragmentLabel::Strict);
  s.contact.fragments = num_fragments(s.contact.fragment_of_tet);
  balance_from_here(s);
}

}  // namespace knap
