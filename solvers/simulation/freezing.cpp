#include "simulation/freezing.hpp"

#include <algorithm>

#include "cohesive/crack_faces.hpp"
#include "cohesive/sleeping_faces.hpp"
#include "contact/contact_pairs.hpp"
#include "fem/sleeping_tets.hpp"
#include "simulation/quiet_fragments.hpp"
#include "simulation/step.hpp"

namespace knap {
namespace {

// A triangulated tool that could touch a body within so many steps wakes it.
constexpr double steps_ahead = 2.0;

// Those of no body work from now on, the others sleep.
void refresh_sleepers(Simulation& s) {
  std::vector<Index> active;
  for (Index tet = 0; tet < s.topology.num_tets(); ++tet)
    if (s.rigid.of_tet(tet) == none) active.push_back(tet);
  set_active_tets(s.elastic, s.topology, s.reference.vertices, active);
  set_sleeping_faces(s.cracks, s.topology, s.rigid.body_of_tet);
}

void freeze(Simulation& s, QuietFragment& fragment) {
  RigidBody& body = fragment.body;
  body.angular_momentum -= take_pending_couples(s.cracks, inner_faces(s.cracks, s.topology, fragment.tets));
  body.angular_momentum_before = body.angular_momentum;
  append_body(s.rigid, body, fragment.tets, fragment.nodes, s.nodes.x);
  for (const Index node : fragment.nodes) {
    s.nodes.v[at(node)] = padded(velocity_at(body, xyz(s.nodes.x[at(node)])));
    s.nodes.f[at(node)] = Vec4::Zero();
  }
}

// The branch energy of what has just gone to sleep is lost with its vibration; what the branch had still to book of it
// is not lost again.
void let_branch_go(Simulation& s, std::span<const QuietFragment> fragments, double bulk_before) {
  BranchState& branch = s.elastic.branch;
  if (branch.groups.empty() || branch.stored <= 0.0) return;
  double gone = bulk_before - bulk_state(s.elastic, s.nodes.x).strain_energy;
  for (const QuietFragment& fragment : fragments) {
    gone -= fragment.body.strain_energy;
    relax_sleeping(s.elastic, s.topology, fragment.tets, s.nodes.x);
  }
  branch.pending -= gone / branch.stored * branch.pending;
  branch.stored -= gone;
}

// The contact layer tells what has hit a body only after it has stopped it.
void note_approaches(Simulation& s) {
  for (const Contact& contact : s.contact.contacts) {
    const auto& [first, second] = contact.sides;
    if (first.body == none && second.body == none) continue;
    const double approach =
        -contact.normal.dot(relative_velocity(contact, s.nodes, s.rigid, s.tools)) - contact.gap / s.clock.dt;
    for (const Index b : {first.body, second.body})
      if (b != none) s.rigid.approach[at(b)] = std::max(s.rigid.approach[at(b)], approach);
  }
}

bool must_wake(const Simulation& s, Index b) {
  const RigidBody& body = s.rigid.bodies[at(b)];
  if (is_near_triangulated_tool(s, s.rigid.nodes_of_body[b], body,
                                steps_ahead * s.clock.dt * fastest_against_tools(body, s.tools)))
    return true;
  if (!body.can_break()) return false;
  const RigidFragmentOptions& options = s.options.rigid_fragments;
  return 0.9 * body.load > options.load_share * body.strength * body.size * body.size ||
         s.rigid.approach[at(b)] > options.approach_share * body.critical_speed;
}

}  // namespace

void freeze_quiet_fragments(Simulation& s) {
  note_changes(s);
  auto quiet = quiet_fragments(s);
  s.freezing.lets_go.assign(at(s.topology.num_tets()), 0);
  for (const QuietFragment& fragment : quiet)
    if (!fragment.is_loose)
      for (const Index tet : fragment.tets) s.freezing.lets_go[at(tet)] = 1;
  std::erase_if(quiet, [](const QuietFragment& fragment) { return !fragment.is_loose; });
  if (quiet.empty()) return;
  update_ledger(s);
  const double before = s.ledger.total();
  const double bulk_before = bulk_state(s.elastic, s.nodes.x).strain_energy;
  s.rigid.body_of_tet.resize(at(s.topology.num_tets()), none);
  for (QuietFragment& fragment : quiet) freeze(s, fragment);
  refresh_sleepers(s);
  let_branch_go(s, quiet, bulk_before);
  update_ledger(s);
  s.freezing.vibration += before - s.ledger.total();
  s.ledger[EnergyTerm::RigidVibration] = s.freezing.vibration;
}

bool wake_loaded_bodies(Simulation& s) {
  note_approaches(s);
  std::vector<std::uint8_t> wakes(s.rigid.bodies.size(), 0);
  for (Index b = 0; b < s.rigid.num_bodies(); ++b) wakes[at(b)] = must_wake(s, b) ? 1 : 0;
  if (std::count(wakes.begin(), wakes.end(), 1) == 0) return false;
  const Csr tets_of_body = make_csr(s.rigid.num_bodies(), s.rigid.body_of_tet);
  for (Index b = 0; b < s.rigid.num_bodies(); ++b) {
    if (wakes[at(b)] == 0) continue;
    const auto faces = inner_faces(s.cracks, s.topology, tets_of_body[b]);
    turn_impulses(s.cracks, s.topology, faces, s.rigid.bodies[at(b)].orientation.toRotationMatrix());
    for (const Index slot : faces) update_normal(s.cracks.faces[at(slot)], s.nodes.x);
    for (const Index tet : tets_of_body[b]) s.freezing.last_change[at(tet)] = s.clock.step;
  }
  remove_bodies(s.rigid, wakes);
  refresh_sleepers(s);
  return true;
}

void average_loads(Simulation& s) {
  for (Index b = 0; b < s.rigid.num_bodies(); ++b) {
    RigidBody& body = s.rigid.bodies[at(b)];
    const double share = std::min(1.0, s.clock.dt / body.crossing_time);
    body.load += share * (s.rigid.push[at(b)] / s.clock.dt - body.load);
  }
}

double frozen_strain_energy(const RigidBodies& rigid) {
  double sum = 0.0;
  for (const RigidBody& body : rigid.bodies) sum += body.strain_energy;
  return sum;
}

}  // namespace knap
