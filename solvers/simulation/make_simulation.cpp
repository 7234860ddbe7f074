#include "simulation/make_simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "cohesive/fragments.hpp"
#include "cohesive/insertion.hpp"
#include "cohesive/strength_field.hpp"
#include "contact/initial_overlap.hpp"
#include "core/errors.hpp"
#include "fem/lumped_mass.hpp"
#include "fem/stable_time_step.hpp"
#include "fem/tet_reference.hpp"
#include "simulation/step.hpp"
#include "simulation/tool_placement.hpp"

namespace knap {
namespace {

// Candidate pairs are kept for fragments that move by this much of the mean edge towards each other.
constexpr double skin_over_edge = 0.1;
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

// Strengths and fracture energies of each particle's facets; the parts of particles that cannot break stay infinite.
void give_strengths(ReferenceState& reference, const Topology& topology, std::span<const ParticleOptions> particles) {
  reference.facet_strength.assign(at(topology.num_facets()), std::numeric_limits<double>::infinity());
  reference.fracture_energy.assign(at(topology.num_facets()), 0.0);
  for (std::size_t p = 0; p < particles.size(); ++p) {
    if (!particles[p].fracture) continue;
    const FractureOptions& fracture = *particles[p].fracture;
    const auto strengths = facet_strengths(topology, reference.tet_volume,
                                           {.strength = fracture.strength,
                                            .weibull_modulus = fracture.weibull_modulus,
                                            .reference_volume = fracture.weibull_reference_volume,
                                            .seed = fracture.weibull_seed});
    for (std::size_t f = 0; f < strengths.size(); ++f) {
      if (reference.particle_of_tet[at(topology.facet_tets[f][0])] != to_index(p)) continue;
      reference.facet_strength[f] = strengths[f];
      reference.fracture_energy[f] = fracture.fracture_energy;
    }
  }
}

// A spring that is so soft that it takes this part of the opening at failure is no bond any more.
constexpr double largest_bond_opening = 0.5;

// The bonds of the particles of intrinsic insertion take over the strengths of their facets.
void make_bonds(ReferenceState& reference, const Topology& topology, std::span<const ParticleOptions> particles,
                std::span<const Material> materials) {
  IntrinsicBonds& bonds = reference.bonds;
  for (std::size_t f = 0; f < topology.facet_tets.size(); ++f) {
    const Index p = reference.particle_of_tet[at(topology.facet_tets[f][0])];
    const auto& fracture = particles[at(p)].fracture;
    if (!fracture || fracture->penalty_ratio == 0.0) continue;
    if (bonds.empty()) {
      bonds.stiffness.assign(topology.facet_tets.size(), 0.0);
      bonds.strength = bonds.stiffness;
    }
    bonds.stiffness[f] =
        fracture->penalty_ratio * p_wave_modulus(materials[at(p)].small_strain()) / reference.facet_size[f];
    bonds.strength[f] = std::exchange(reference.facet_strength[f], std::numeric_limits<double>::infinity());
    const double opening = bonds.strength[f] / bonds.stiffness[f];
    if (opening * bonds.strength[f] > largest_bond_opening * 2.0 * reference.fracture_energy[f])
      throw InputError(fmt::format(
          "fracture.penalty_ratio = {}: too soft for elements of {:.3g} m; a facet's spring takes up {:.3g} "
          "m of the {:.3g} m that separate it. Larger values or smaller elements are needed",
          fracture->penalty_ratio, reference.facet_size[f], opening,
          2.0 * reference.fracture_energy[f] / bonds.strength[f]));
  }
}

// The smaller friction decides: that is where faces start to slide.
std::vector<double> pair_friction(std::span<const ParticleOptions> particles, std::span<const CohesiveLaw> laws) {
  std::vector<double> friction;
  for (std::size_t a = 0; a < particles.size(); ++a)
    for (std::size_t b = 0; b < particles.size(); ++b)
      friction.push_back(a == b ? laws[a].sliding_friction : std::min(particles[a].friction, particles[b].friction));
  return friction;
}

// Velocities of the nodes [first, last) of one particle.
void set_in_motion(NodalState& nodes, std::size_t first_node, std::size_t last, const ParticleOptions& particle) {
  Vec3 first = Vec3::Zero();
  double mass = 0.0;
  for (std::size_t i = first_node; i < last; ++i) {
    first += nodes.mass[i] * xyz(nodes.x[i]);
    mass += nodes.mass[i];
  }
  const Vec3 centre = first / mass;
  for (std::size_t i = first_node; i < last; ++i)
    nodes.v[i] = padded(particle.velocity + particle.spin.cross(xyz(nodes.x[i]) - centre));
}

NodalState nodes_at_start(const SimulationOptions& options, const ReferenceState& reference, const Topology& topology,
                          std::span<const TetMesh> meshes) {
  NodalState nodes;
  const std::size_t count = reference.vertices.size();
  nodes.x.assign(count, Vec4::Zero());
  nodes.f = nodes.v = nodes.x;
  nodes.mass.assign(count, 0.0);
  for (Index i = 0; i < nodes.size(); ++i) {
    nodes.mass[at(i)] = corner_sum(topology.corners_of_vertex[i], reference.corner_mass);
    nodes.x[at(i)] = padded(reference.vertices[at(i)]);
  }
  std::size_t first = 0;
  for (std::size_t p = 0; p < meshes.size(); ++p) {
    set_in_motion(nodes, first, first + meshes[p].vertices.size(), options.particles[p]);
    first += meshes[p].vertices.size();
  }
  nodes.v_before = nodes.v;
  return nodes;
}

// Strain energy that round-off is small beside and any load is large beside.
double energy_of_nothing(const Simulation& s) {
  constexpr double strain_at_rest = 1e-6;
  double stiffness = 0.0;
  for (std::size_t tet = 0; tet < s.reference.tet_volume.size(); ++tet)
    stiffness += s.options.particles[at(s.reference.particle_of_tet[tet])].young_modulus * s.reference.tet_volume[tet];
  return 0.5 * stiffness * strain_at_rest * strain_at_rest;
}

// What errors are measured against: the energy that comes in.
double energy_to_compare_with(const Simulation& s) {
  double incident = s.reference.incident_energy;
  for (const Tool& tool : s.tools) incident += kinetic_energy(tool);
  return incident > 0.0 ? incident : energy_of_nothing(s);
}

std::vector<Material> make_materials(std::span<const ParticleOptions> particles) {
  std::vector<Material> all;
  for (const ParticleOptions& p : particles)
    all.push_back(make_material(p.young_modulus, p.poisson_ratio, p.density, {p.viscous_ratio, p.relaxation_time}));
  return all;
}

std::vector<Index> first_vertices(std::span<const TetMesh> meshes) {
  std::vector<Index> first{0};
  for (const TetMesh& mesh : meshes.first(meshes.size() - 1)) first.push_back(first.back() + mesh.num_vertices());
  return first;
}

// Masses and stiffnesses of the corners of all particles.
void weigh(ReferenceState& reference, const TetMesh& mesh, const Topology& topology,
           std::span<const Material> materials) {
  std::vector<double> densities;
  for (const Index p : reference.particle_of_tet) densities.push_back(materials[at(p)].density);
  reference.corner_mass = corner_masses(topology, reference.tet_volume, densities);
  for (std::size_t p = 0, first = 0; p < materials.size(); ++p) {
    const auto count = static_cast<std::size_t>(
        std::count(reference.particle_of_tet.begin(), reference.particle_of_tet.end(), to_index(p)));
    const auto stiffness = corner_stiffnesses(std::span(mesh.tets).subspan(first, count), mesh.vertices, materials[p]);
    reference.corner_stiffness.insert(reference.corner_stiffness.end(), stiffness.begin(), stiffness.end());
    first += count;
  }
}

ReferenceState make_reference(const SimulationOptions& options, std::span<const TetMesh> meshes, const TetMesh& all,
                              const Topology& topology, std::span<const Material> materials) {
  ReferenceState reference;
  reference.vertices = all.vertices;
  reference.tet_volume = tet_volumes(all.tets, all.vertices);
  reference.mean_edge = mean_edge(all);
  for (std::size_t p = 0; p < meshes.size(); ++p)
    reference.particle_of_tet.insert(reference.particle_of_tet.end(), meshes[p].tets.size(), to_index(p));
  for (const ParticleOptions& particle : options.particles)
    reference.laws.push_back(particle.fracture ? particle.fracture->law : CohesiveLaw{});
  reference.pair_friction = pair_friction(options.particles, reference.laws);
  weigh(reference, all, topology, materials);
  measure_facets(reference, topology);
  if (!can_break(options)) return reference;
  give_strengths(reference, topology, options.particles);
  make_bonds(reference, topology, options.particles, materials);
  if (!reference.bonds.empty())
    add_bond_stiffnesses(reference.bonds, topology, {reference.laws, reference.particle_of_tet}, reference.facet_area,
                         reference.corner_stiffness);
  return reference;
}

// What errors of the energy balance are measured against. Particles that meet in flight know nothing of a common
// velocity; a tool does.
double incident_energy(const SimulationOptions& options, const NodalState& nodes, const Momentum& start) {
  const double total = kinetic_energy(nodes);
  if (options.particles.size() == 1 || !options.tools.empty()) return total;
  return total - 0.5 * start.mass * start.velocity().squaredNorm();
}

void refuse_overlap(const Simulation& s) {
  if (s.options.particles.size() == 1) return;
  const auto tets = overlapping_tets(s.topology.tet_nodes, s.nodes.x, s.reference.particle_of_tet);
  if (!tets) return;
  const auto particle = [&](std::size_t i) { return s.reference.particle_of_tet[at((*tets)[i])] + 1; };
  const Vec3 place = xyz(s.nodes.x[at(s.topology.tet_nodes[at((*tets)[0])][0])]);
  throw InputError(
      fmt::format("particles {} and {} overlap at the start, near ({:.4g}, {:.4g}, {:.4g}) m: move them apart",
                  particle(0), particle(1), place.x(), place.y(), place.z()));
}

void part_bonded_corners(Simulation& s) {
  if (s.reference.bonds.empty()) return;
  std::vector<Index> tets;
  for (Index tet = 0; tet < s.topology.num_tets(); ++tet) {
    const auto& fracture = s.options.particles[at(s.reference.particle_of_tet[at(tet)])].fracture;
    if (fracture && fracture->penalty_ratio > 0.0) tets.push_back(tet);
  }
  part_corners(s.topology, s.nodes, tets, s.reference.corner_mass);
}

// `stored` counts as energy that comes in [J]: what a particle made without strain holds is round-off.
void begin_balances(Simulation& s, double stored) {
  s.reference.start = momentum(s.nodes);
  s.reference.start_potential = gravity_potential(s, -0.5 * s.clock.dt);
  s.reference.incident_energy = incident_energy(s.options, s.nodes, s.reference.start) + stored;
  s.ledger.reference = energy_to_compare_with(s);
  balance_energies(s);
  s.ledger[EnergyTerm::Strain] = strain_energy(s.elastic, s.nodes.x) + half_step_work(s.nodes, s.clock.dt);
  s.ledger[EnergyTerm::Gravity] = 0.0;
  s.ledger.initial = s.ledger.total();
  s.ledger.max_closure_error = 0.0;
  s.last_good_ledger = s.ledger;
}

}  // namespace

Simulation make_simulation(const SimulationOptions& options, std::span<const TetMesh> meshes) {
  if (meshes.empty() || meshes.size() != options.particles.size())
    throw InputError(
        fmt::format("{} meshes for {} particles; each needs one", meshes.size(), options.particles.size()));
  if (!options.prescribed.empty() && options.rigid_fragments.enabled)
    throw InputError("nodes of prescribed velocity cannot be part of rigid fragments: leave one of both out");
  const TetMesh all = merged(meshes);
  const std::vector<Material> materials = make_materials(options.particles);
  Simulation s;
  s.options = options;
  s.topology = make_topology(all);
  s.reference = make_reference(options, meshes, all, s.topology, materials);
  s.nodes = nodes_at_start(options, s.reference, s.topology, meshes);
  refuse_overlap(s);
  part_bonded_corners(s);
  s.reference.critical_step = critical_time_step(s.topology, s.reference.corner_stiffness, s.nodes.mass);
  s.clock.dt = options.step_safety * s.reference.critical_step;
  s.elastic = make_elastic_force(s.topology, all.vertices, materials, s.reference.particle_of_tet);

  s.cracks = make_crack_state(s.topology, first_vertices(meshes));
  s.contact.fragment_of_tet = fragment_labels(s.topology, s.cracks, FragmentLabel::Strict);
  s.contact.fragments = num_fragments(s.contact.fragment_of_tet);
  s.contact.skin = skin_over_edge * s.reference.mean_edge;

  s.prescribed = make_prescribed(options.prescribed, s.topology.num_vertices());
  s.tools = make_tools(options.tools, s.clock.dt);
  check_tools_are_outside(s);
  s.tool_edges = make_edge_watch(s.tools, spacing_over_edge * s.reference.mean_edge);
  update_elastic_forces(s.elastic, s.nodes.x, s.nodes.f, 0.0);
  begin_balances(s, 0.0);
  return s;
}

void balance_from_here(Simulation& s) {
  const double stored = strain_energy(s.elastic, s.nodes.x);
  begin_balances(s, stored > energy_of_nothing(s) ? stored : 0.0);
}

}  // namespace knap
