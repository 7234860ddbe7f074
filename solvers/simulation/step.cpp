#include "simulation/step.hpp"

#include <algorithm>
#include <cmath>

#include "cohesive/crack_faces.hpp"
#include "cohesive/fragments.hpp"
#include "cohesive/hand_over.hpp"
#include "cohesive/insertion.hpp"
#include "contact/broad_phase.hpp"
#include "contact/contact_pairs.hpp"
#include "simulation/freezing.hpp"
#include "simulation/mass_scaling.hpp"
#include "time/rigid_motion.hpp"

namespace knap {
namespace {

// A node this much of the mean edge inside a tool is not thrown out: far more than round-off, far less than matters.
constexpr double landing_tolerance_over_edge = 1e-6;

VertexImpulseOptions impulse_options(const Simulation& s) {
  return {s.reference.laws, s.clock.dt, s.options.impulse_sweeps};
}

bool looks_for_fragments(const Simulation& s) { return s.clock.step % s.options.label_interval == 0; }

bool has_cracks(const Simulation& s) { return !s.cracks.vertices.empty(); }

BondScene bond_scene(const Simulation& s) {
  return {s.topology, s.nodes.x, s.reference.facet_area, {s.reference.laws, s.reference.particle_of_tet}};
}

std::vector<OverloadedFacet> find_overloaded(const Simulation& s) {
  auto facets = overloaded_facets(s.topology, s.nodes.x, {s.elastic.stress, s.elastic.stress_bound},
                                  s.reference.facet_strength, {s.reference.laws, s.reference.particle_of_tet});
  if (s.reference.bonds.empty()) return facets;
  const auto bonds = overloaded_bonds(s.reference.bonds, bond_scene(s));
  facets.insert(facets.end(), bonds.begin(), bonds.end());
  std::sort(facets.begin(), facets.end(), [](const auto& a, const auto& b) { return a.facet < b.facet; });
  return facets;
}

void insert_new_cracks(Simulation& s) {
  if (!can_break(s.options) || s.clock.step % s.options.insertion_interval != 0) return;
  const PhaseTimer timer(s.phase_times, Phase::Insertion);
  update_stress(s.elastic, s.nodes.x);
  const auto overloaded = find_overloaded(s);
  if (overloaded.empty()) return;
  const auto change = insert_cracks(s.cracks, s.topology, s.nodes, overloaded,
                                    {.dt = s.clock.dt,
                                     .fracture_energy = s.reference.fracture_energy,
                                     .facet_area = s.reference.facet_area,
                                     .corner_mass = s.reference.corner_mass,
                                     .stress = s.elastic.stress,
                                     .laws = {s.reference.laws, s.reference.particle_of_tet},
                                     .bond_stiffness = s.reference.bonds.stiffness});
  refresh_elastic_force(s.elastic, s.topology, change.changed_tets);
  scale_masses(s, change.split_vertices);
  s.totals.inserted_facets += static_cast<std::int64_t>(overloaded.size());
  s.cracks.last_damage_step = s.clock.step;
}

void update_bulk(Simulation& s) {
  const PhaseTimer timer(s.phase_times, Phase::BulkForces);
  update_elastic_forces(s.elastic, s.nodes.x, s.nodes.f, s.clock.dt);
  if (!s.reference.bonds.empty()) add_bond_forces(s.reference.bonds, bond_scene(s), s.nodes.f);
}

void kick_nodes(Simulation& s) {
  const PhaseTimer timer(s.phase_times, Phase::Motion);
  kick(s.nodes, s.clock.dt, s.rigid.body_of_node);
  if (!s.options.gravity.isZero(0.0)) s.totals.gravity += add_gravity(s.nodes, s.options.gravity, s.clock.dt);
  kick(s.rigid, s.options.gravity, s.clock.dt);
}

void lead_prescribed_nodes(Simulation& s) {
  if (s.prescribed.empty()) return;
  const PhaseTimer timer(s.phase_times, Phase::Motion);
  lead_nodes(s.prescribed, s.options.prescribed, s.nodes);
}

void drift_nodes(Simulation& s) {
  {
    const PhaseTimer timer(s.phase_times, Phase::Motion);
    drift(s.nodes, s.clock.dt, s.rigid.body_of_node);
    move_tools(s.tools);
  }
  if (s.rigid.bodies.empty()) return;
  const PhaseTimer timer(s.phase_times, Phase::RigidBodies);
  drift(s.rigid, s.clock.dt);
  place_nodes(s.rigid, s.nodes);
}

ContactScene scene(const Simulation& s) { return {s.topology, s.nodes.x, s.rigid, s.tools, s.clock.dt}; }

// Before their contacts are solved, so that these act on what can deform.
void wake_bodies(Simulation& s) {
  if (s.rigid.bodies.empty()) return;
  const PhaseTimer timer(s.phase_times, Phase::RigidBodies);
  if (wake_loaded_bodies(s)) refresh_contacts(s.contact, scene(s));
  clear_contact_reports(s.rigid);
}

// The impulses of the step are known.
void settle_bodies(Simulation& s) {
  if (s.rigid.bodies.empty()) return;
  const PhaseTimer timer(s.phase_times, Phase::RigidBodies);
  update_node_velocities(s.rigid, s.nodes);
  average_loads(s);
}

void freeze_fragments(Simulation& s) {
  if (!s.options.rigid_fragments.enabled || !looks_for_fragments(s) || s.contact.fragments < 2) return;
  const PhaseTimer timer(s.phase_times, Phase::RigidBodies);
  freeze_quiet_fragments(s);
}

void update_faces(Simulation& s) {
  if (!has_cracks(s)) return;
  const PhaseTimer timer(s.phase_times, Phase::CrackFaces);
  const Index turn = looks_for_fragments(s) ? all_turns : static_cast<Index>(s.clock.step % num_turns);
  update_crack_faces(s.cracks, s.topology, s.nodes, turn);
}

// While something breaks, the next look for fragments will bring new ones and with them the next rebuild.
void rebuild_contact_candidates(Simulation& s) {
  constexpr double looks_in_quiet = 4.0;
  const bool is_quiet = s.clock.step - s.cracks.last_damage_step > s.options.label_interval;
  const double time_ahead = (is_quiet ? looks_in_quiet : 1.0) * s.options.label_interval * s.clock.dt;
  const auto joints = fragment_joints(s.cracks, s.topology, s.contact.fragment_of_tet);
  rebuild_candidates(s.contact, {s.topology, s.nodes, s.rigid, joints, time_ahead});
}

// Returns whether the candidates for contact have been found anew.
bool look_for_new_fragments(Simulation& s) {
  auto labels = fragment_labels(s.topology, s.cracks, FragmentLabel::Strict);
  const bool changed = labels != s.contact.fragment_of_tet;
  s.contact.fragments = num_fragments(labels);
  s.contact.fragment_of_tet = std::move(labels);
  const Index handed_over = hand_over_faces(s.cracks, s.topology, s.nodes.x, s.contact.fragment_of_tet,
                                            {.lets_go = s.freezing.lets_go, .facet_size = s.reference.facet_size});
  if (!changed && handed_over == 0 && !s.contact.margin.empty()) return false;
  rebuild_contact_candidates(s);
  return true;
}

void detect_contacts(Simulation& s) {
  if (s.contact.fragments < 2 && s.totals.inserted_facets == 0) return;  // in one piece
  const PhaseTimer timer(s.phase_times, Phase::ContactDetection);
  const bool rebuilt = looks_for_fragments(s) && look_for_new_fragments(s);
  if (s.contact.fragments < 2) return;
  // The way of the last drift.
  const bool gone_far = !rebuilt && advance_travel(s.contact, {s.nodes.v, s.rigid}, s.clock.dt);
  if (gone_far) rebuild_contact_candidates(s);
  if (rebuilt || gone_far || s.clock.step % s.options.contact_interval == 0) {
    refresh_contacts(s.contact, scene(s));
  } else {
    follow_contacts(s.contact, scene(s));
  }
}

void apply_crack_impulses(Simulation& s) {
  if (!has_cracks(s)) return;
  const PhaseTimer timer(s.phase_times, Phase::VertexImpulses);
  apply_vertex_impulses(s.cracks, s.nodes, impulse_options(s));
}

void apply_fragment_contacts(Simulation& s) {
  if (s.contact.contacts.empty()) return;
  const PhaseTimer timer(s.phase_times, Phase::ContactImpulses);
  apply_contact_impulses(
      s.contact, {s.nodes, s.rigid, s.tools, s.clock.dt, s.clock.step},
      {.pairs = {s.reference.pair_friction, s.reference.particle_of_tet, to_index(s.options.particles.size())},
       .restitution = s.options.restitution,
       .slowest = 2.0 * s.options.gravity.norm() * s.clock.dt,
       .sweeps = s.options.contact_sweeps});
  for (const Contact& contact : s.contact.contacts)
    if (contact.total_impulse().squaredNorm() > 0.0) s.totals.last_contact_step = s.clock.step;
}

void apply_tool_impulses(Simulation& s) {
  s.nodes_on_tools.clear();
  if (s.tools.empty()) return;
  const PhaseTimer timer(s.phase_times, Phase::Tools);
  const ToolStep in_step{.dt = s.clock.dt,
                         .step = s.clock.step,
                         .tolerance = landing_tolerance_over_edge * s.reference.mean_edge,
                         .body_of_node = s.rigid.body_of_node};
  if (looks_for_fragments(s) || s.tool_edges.tets.empty()) watch_free_faces(s.tool_edges, s.topology);
  auto touches = find_edge_touches(s.tool_edges, s.tools, s.topology, s.nodes, in_step);
  s.nodes_on_tools = apply_tools(s.tools, s.nodes, in_step, touches, tool_deeds(s.contact, s.rigid, s.tools));
}

void book_losses(Simulation& s) {
  const PhaseTimer timer(s.phase_times, Phase::Booking);
  book_contact_losses(s.contact, s.nodes, s.rigid);
  if (!has_cracks(s)) return;
  std::vector<Index> changed = s.nodes_on_tools;
  for (const PrescribedNodes& group : s.prescribed)
    changed.insert(changed.end(), group.nodes.begin(), group.nodes.end());
  for (const Contact& contact : s.contact.contacts)
    for (const ContactSide& side : contact.sides)
      if (side.is_deformable()) changed.insert(changed.end(), side.nodes.begin(), side.nodes.end());
  settle_crack_losses(s.cracks, s.topology, s.nodes, std::move(changed), impulse_options(s));
  if (looks_for_fragments(s)) tidy_faces(s.cracks);
}

void balance_tools(Simulation& s) {
  EnergyLedger& ledger = s.ledger;
  ledger[EnergyTerm::ToolFriction] = ledger[EnergyTerm::ToolImpact] = 0.0;
  ledger[EnergyTerm::ToolWork] = ledger[EnergyTerm::ToolKinetic] = 0.0;
  for (const Tool& tool : s.tools) {
    ledger[EnergyTerm::ToolFriction] += tool.state.friction_loss;
    ledger[EnergyTerm::ToolImpact] += tool.state.impact_loss;
    if (!tool.is_guided()) ledger[EnergyTerm::ToolWork] -= tool.state.work;
    ledger[EnergyTerm::ToolKinetic] += kinetic_energy(tool);
  }
  for (const PrescribedNodes& group : s.prescribed) ledger[EnergyTerm::ToolWork] -= group.state.work;
  ledger[EnergyTerm::Gravity] = gravity_potential(s, 0.5 * s.clock.dt) - s.reference.start_potential;
}

StepStatus check_energies(Simulation& s) {
  if (s.clock.step % s.options.ledger_interval != 0) return StepStatus::Ok;
  const PhaseTimer timer(s.phase_times, Phase::Ledger);
  balance_energies(s);
  const double error = s.ledger.closure_error();
  if (!std::isfinite(error)) return StepStatus::NotFinite;
  return error > energy_stop ? StepStatus::EnergyNotClosed : StepStatus::Ok;
}

}  // namespace

double gravity_potential(const Simulation& s, double ahead) {
  const Vec3& gravity = s.options.gravity;
  if (gravity.isZero(0.0)) return 0.0;
  double potential = gravity_potential(s.nodes, gravity, ahead);
  for (const Tool& tool : s.tools)
    potential -= tool.mass * gravity.dot(tool.state.position + ahead * tool.state.velocity);
  return potential;
}

void update_ledger(Simulation& s) {
  EnergyLedger& ledger = s.ledger;
  ledger[EnergyTerm::Kinetic] = kinetic_energy(s.nodes);
  const BulkState bulk = bulk_state(s.elastic, s.nodes.x);
  s.totals.smallest_volume_ratio = std::min(s.totals.smallest_volume_ratio, bulk.smallest_volume_ratio);
  ledger[EnergyTerm::Strain] = bulk.strain_energy - half_step_work(s.nodes, s.clock.dt) + frozen_strain_energy(s.rigid);
  if (can_break(s.options)) {
    const CrackEnergies cracks = crack_energies(s.cracks, s.nodes, impulse_options(s));
    ledger[EnergyTerm::CohesiveStored] = cracks.stored;
    if (!s.reference.bonds.empty()) ledger[EnergyTerm::CohesiveStored] += bond_energy(s.reference.bonds, bond_scene(s));
    ledger[EnergyTerm::CohesiveDissipated] = cracks.losses.cohesive;
    ledger[EnergyTerm::ClosureImpact] = cracks.losses.closure;
    ledger[EnergyTerm::CrackFriction] = cracks.losses.friction;
  }
  ledger[EnergyTerm::ContactDissipated] = s.contact.dissipated;
  balance_tools(s);
  ledger[EnergyTerm::Viscous] = s.elastic.branch.dissipated;
  ledger[EnergyTerm::RigidVibration] = s.freezing.vibration;
  ledger[EnergyTerm::MassScaling] = 0.0 - s.totals.mass_scaling_energy;
  const double supplied = std::max(0.0, -ledger[EnergyTerm::ToolWork]) + std::max(0.0, -ledger[EnergyTerm::Gravity]);
  ledger.reference = std::max(ledger.reference, s.reference.incident_energy + supplied);
}

void balance_energies(Simulation& s) {
  update_ledger(s);
  EnergyLedger& ledger = s.ledger;
  const double error = ledger.closure_error();
  ledger.max_closure_error = std::max(ledger.max_closure_error, error);
  if (error <= energy_warning) s.last_good_ledger = ledger;
}

StepStatus step(Simulation& s) {
  aim_tools(s.tools, s.options.tools, s.options.gravity, s.clock.time(), s.clock.dt);
  insert_new_cracks(s);
  aim_nodes(s.prescribed, s.options.prescribed, s.topology, s.clock.time(), s.clock.dt);
  update_faces(s);
  detect_contacts(s);
  wake_bodies(s);
  update_bulk(s);
  kick_nodes(s);
  lead_prescribed_nodes(s);
  apply_crack_impulses(s);
  apply_fragment_contacts(s);
  lead_prescribed_nodes(s);
  apply_tool_impulses(s);
  settle_bodies(s);
  book_losses(s);
  const StepStatus status = check_energies(s);
  freeze_fragments(s);
  drift_nodes(s);
  ++s.clock.step;
  return status;
}

}  // namespace knap
