#include "simulation/make_simulation.hpp"

#include <fmt/format.h>

#include <numeric>

#include "cohesive/insertion.hpp"
#include "cohesive/strength_field.hpp"
#include "core/errors.hpp"
#include "fem/lumped_mass.hpp"
#include "fem/stable_time_step.hpp"
#include "fem/tet_reference.hpp"
#include "simulation/step.hpp"
#include "simulation/tool_placement.hpp"

namespace knap {
namespace {

// Candidate pairs are kept for fragments that move by this much of the mean edge towards each other.
constexpr double skin_over_edge = 0.3;
// Of the points on tools' edges over the mean edge: one at least in every face that an edge crosses.
constexpr double spacing_over_edge = 0.4;

void measure_facets(ReferenceState& reference, const Topology& topology) {
  reference.facet_area.reserve(at(topology.num_facets()));
  reference.facet_size.reserve(at(topology.num_facets()));
  for (Index facet = 0; facet < topology.num_facets(); ++facet) {
    const Vec3& a = reference.vertices[at(topology.facet_vertex(facet, 0))];
    const Vec3& b = reference.vertices[at(topology.facet_vertex(facet, 1))];
    const Vec3& c = reference.vertices[at(topology.facet_vertex(facet, 2))];
    const double area = 0.5 * (b - a).cross(c - a).norm();
    const auto& [minus, plus] = topology.facet_tets[at(facet)];
    reference.facet_area.push_back(area);
    reference.facet_size.push_back(1.5 * (reference.tet_volume[at(minus)] + reference.tet_volume[at(plus)]) / area);
  }
}

void give_strengths(ReferenceState& reference, const Topology& topology, const FractureOptions& fracture) {
  reference.facet_strength = facet_strengths(topology, reference.tet_volume,
                                             {.strength = fracture.strength,
                                              .weibull_modulus = fracture.weibull_modulus,
                                              .reference_volume = fracture.weibull_reference_volume,
                                              .seed = fracture.weibull_seed});
  reference.fracture_energy.assign(at(topology.num_facets()), fracture.fracture_energy);
}

NodalState nodes_at_start(const SimulationOptions& options, const ReferenceState& reference, const Topology& topology) {
  NodalState nodes;
  const std::size_t count = reference.vertices.size();
  nodes.x.assign(count, Vec4::Zero());
  nodes.f = nodes.v = nodes.x;
  nodes.mass.assign(count, 0.0);
  Vec3 first = Vec3::Zero();
  double mass = 0.0;
  for (Index i = 0; i < nodes.size(); ++i) {
    nodes.mass[at(i)] = corner_sum(topology.corners_of_vertex[i], reference.corner_mass);
    nodes.x[at(i)] = padded(reference.vertices[at(i)]);
    first += nodes.mass[at(i)] * reference.vertices[at(i)];
    mass += nodes.mass[at(i)];
  }
  const Vec3 centre = first / mass;
  for (Index i = 0; i < nodes.size(); ++i)
    nodes.v[at(i)] = padded(options.velocity + options.spin.cross(reference.vertices[at(i)] - centre));
  nodes.v_before = nodes.v;
  return nodes;
}

// What errors are measured against: the kinetic energy that comes in, and at rest one that round-off is small beside.
double energy_to_compare_with(const Simulation& s) {
  constexpr double strain_at_rest = 1e-6;
  double incident = s.reference.incident_energy;
  for (const Tool& tool : s.tools) incident += kinetic_energy(tool);
  if (incident > 0.0) return incident;
  const double volume = std::accumulate(s.reference.tet_volume.begin(), s.reference.tet_volume.end(), 0.0);
  return 0.5 * s.options.young_modulus * strain_at_rest * strain_at_rest * volume;
}

}  // namespace

Simulation make_simulation(const SimulationOptions& options, const TetMesh& mesh) {
  Simulation s;
  s.options = options;
  s.topology = make_topology(mesh);
  ReferenceState& reference = s.reference;
  reference.vertices = mesh.vertices;
  reference.tet_volume = tet_volumes(mesh.tets, mesh.vertices);
  reference.mean_edge = mean_edge(mesh);
  reference.corner_mass = corner_masses(s.topology, reference.tet_volume, options.density);
  measure_facets(reference, s.topology);
  s.nodes = nodes_at_start(options, reference, s.topology);

  const Material material = make_material(options.young_modulus, options.poisson_ratio, options.density,
                                          {options.viscous_ratio, options.relaxation_time});
  reference.corner_stiffness = corner_stiffnesses(mesh.tets, mesh.vertices, material);
  reference.critical_step = critical_time_step(s.topology, reference.corner_stiffness, s.nodes.mass);
  s.clock.dt = options.step_safety * reference.critical_step;
  s.elastic = make_elastic_force(s.topology, mesh.vertices, material);

  s.cracks = make_crack_state(s.topology);
  if (options.fracture) give_strengths(reference, s.topology, *options.fracture);
  s.contact.fragment_of_tet.assign(mesh.tets.size(), 0);
  s.contact.skin = skin_over_edge * reference.mean_edge;

  s.tools = make_tools(options.tools, s.clock.dt);
  check_tools_are_outside(s);
  s.tool_edges = make_edge_watch(s.tools, spacing_over_edge * reference.mean_edge);
  reference.start_potential = gravity_potential(s, -0.5 * s.clock.dt);

  reference.start = momentum(s.nodes);
  reference.incident_energy = kinetic_energy(s.nodes);
  s.ledger.reference = energy_to_compare_with(s);
  update_elastic_forces(s.elastic, s.nodes.x, s.nodes.f, 0.0);
  balance_energies(s);
  s.ledger[EnergyTerm::Gravity] = 0.0;  // the velocities are those of half a step before
  s.ledger.initial = s.ledger.total();
  s.ledger.max_closure_error = 0.0;
  return s;
}

}  // namespace knap
