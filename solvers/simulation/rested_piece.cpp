#include "simulation/rested_piece.hpp"

#include <cassert>

#include "simulation/make_simulation.hpp"

namespace knap {
namespace {

TetMesh mesh_of(const Simulation& s, std::span<const Index> label_of_tet, Index label) {
  std::vector<Index> number(s.reference.vertices.size(), none);
  std::vector<TetCorners> tets;
  for (std::size_t tet = 0; tet < label_of_tet.size(); ++tet) {
    if (label_of_tet[tet] != label) continue;
    tets.push_back(s.topology.tet_vertices[tet]);
    for (const Index vertex : tets.back()) number[at(vertex)] = 0;
  }
  TetMesh mesh{.vertices = {}, .tets = std::move(tets)};
  for (std::size_t vertex = 0; vertex < number.size(); ++vertex) {
    if (number[vertex] == none) continue;
    number[vertex] = mesh.num_vertices();
    mesh.vertices.push_back(s.reference.vertices[vertex]);
  }
  for (TetCorners& tet : mesh.tets)
    for (Index& vertex : tet) vertex = number[at(vertex)];
  return mesh;
}

// By facet and corner, of those cracked: effective traction at insertion [Pa] and damage. What has been handed over has
// no records any more.
struct CrackedFacet {
  double strength = 0.0;
  std::array<double, 3> damage{1.0, 1.0, 1.0};
};
std::vector<CrackedFacet> cracked_facets(const Simulation& s) {
  std::vector<CrackedFacet> cracked(at(s.topology.num_facets()));
  for (std::size_t facet = 0; facet < cracked.size(); ++facet)
    if (s.topology.facet_state[facet] != FacetState::Bonded)
      cracked[facet].strength = s.reference.facet_strength[facet];
  for (const CrackRecord& record : s.cracks.records) {
    const CrackFace& face = s.cracks.faces[at(record.face)];
    CrackedFacet& facet = cracked[at(face.facet)];
    facet.strength = 3.0 * record.strength / face.area;
    facet.damage[record.corner] = record.regime == RecordRegime::Failed ? 1.0 : record.damage();
  }
  return cracked;
}

}  // namespace

RestedPiece rested_piece(const Simulation& s, std::span<const Index> label_of_tet, Index label) {
  assert(s.options.particles.size() == 1 && label_of_tet.size() == at(s.topology.num_tets()));
  RestedPiece piece{.mesh = mesh_of(s, label_of_tet, label), .facet_strength = {}, .fracture_energy = {}, .cracks = {}};
  if (!can_break(s.options)) return piece;
  const auto cracked = cracked_facets(s);
  // Facets are numbered by their tets' corners, whose order the piece keeps.
  for (std::size_t facet = 0; facet < cracked.size(); ++facet) {
    const auto& [minus, plus] = s.topology.facet_tets[facet];
    if (label_of_tet[at(minus)] != label || label_of_tet[at(plus)] != label) continue;
    if (s.topology.facet_state[facet] != FacetState::Bonded)
      piece.cracks.push_back({to_index(piece.facet_strength.size()), cracked[facet].strength, cracked[facet].damage});
    piece.facet_strength.push_back(s.reference.facet_strength[facet]);
    piece.fracture_energy.push_back(s.reference.fracture_energy[facet]);
  }
  return piece;
}

Simulation make_simulation(const SimulationOptions& options, const RestedPiece& piece) {
  Simulation s = make_simulation(options, piece.mesh);
  if (!can_break(options)) return s;
  assert(piece.facet_strength.size() == at(s.topology.num_facets()));
  s.reference.facet_strength = piece.facet_strength;
  s.reference.fracture_energy = piece.fracture_energy;
  open_initial_cracks(s, piece.cracks);
  return s;
}

}  // namespace knap
