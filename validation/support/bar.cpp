#include "validation/support/bar.hpp"

#include <limits>

#include "tests/support/bar_mesh.hpp"

namespace knap {

Simulation make_bar(const BarOptions& bar) {
  const TetMesh mesh = bar_mesh({bar.cells, 1, 1}, bar.cell);
  ParticleOptions particle{.young_modulus = bar.young_modulus, .poisson_ratio = 0.0, .density = bar.density};
  particle.fracture = FractureOptions{.strength = bar.strength, .fracture_energy = bar.fracture_energy};
  SimulationOptions options{.particles = {particle}, .step_safety = bar.step_safety};
  options.prescribed = {{.axes = {false, true, true}}};
  for (Index i = 0; i < mesh.num_vertices(); ++i) options.prescribed[0].vertices.push_back(i);
  if (bar.ends_are_led) {
    const Index last = mesh.num_vertices() - 1;
    options.prescribed.push_back({.vertices = {0, 1, 2, 3}, .axes = {true, false, false}});
    options.prescribed.push_back({.vertices = {last - 3, last - 2, last - 1, last},
                                  .axes = {true, false, false},
                                  .velocity = {bar.end_speed, 0.0, 0.0}});
  }
  Simulation s = make_simulation(options, mesh);
  for (Index f = 0; f < s.topology.num_facets(); ++f)
    if (plane_of_facet(s, bar, f) == none) s.reference.facet_strength[at(f)] = std::numeric_limits<double>::infinity();
  return s;
}

Index plane_of_facet(const Simulation& s, const BarOptions& bar, Index facet) {
  std::array<Index, 3> plane{};
  for (int k = 0; k < 3; ++k)
    plane[at(k)] =
        static_cast<Index>(std::lround(s.reference.vertices[at(s.topology.facet_vertex(facet, k))].x() / bar.cell));
  return plane[0] == plane[1] && plane[0] == plane[2] ? plane[0] : none;
}

std::vector<Index> failed_planes(const Simulation& s, const BarOptions& bar) {
  std::vector<int> failed_facets(at(bar.cells), 0);
  for (Index f = 0; f < s.topology.num_facets(); ++f) {
    const FacetState state = s.topology.facet_state[at(f)];
    if (state == FacetState::Failed || state == FacetState::HandedOver) ++failed_facets[at(plane_of_facet(s, bar, f))];
  }
  std::vector<Index> planes;
  for (Index plane = 1; plane < bar.cells; ++plane)
    if (failed_facets[at(plane)] == 2) planes.push_back(plane);
  return planes;
}

}  // namespace knap
