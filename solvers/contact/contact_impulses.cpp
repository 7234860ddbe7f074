#include "contact/contact_impulses.hpp"

#include <algorithm>
#include <cmath>

namespace knap {
namespace {

// Contacts have settled when a sweep changes no velocity by more than this share of the largest approach.
constexpr double settled = 1e-10;

Vec3 side_velocity(const ContactSide& side, const Vec3& place, const std::vector<Vec4>& v, const RigidBodies& rigid) {
  if (side.body != none) return velocity_at(rigid.bodies[at(side.body)], place);
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < 4; ++i) sum += side.weights[i] * xyz(v[at(side.nodes[i])]);
  return sum;
}

Vec3 side_velocity_before(const ContactSide& side, const Vec3& place, const NodalState& nodes,
                          const RigidBodies& rigid) {
  if (side.body != none) return velocity_before_at(rigid.bodies[at(side.body)], place);
  return side_velocity(side, place, nodes.v_before, rigid);
}

// Of the second side relative to the first.
Vec3 relative_velocity(const Contact& c, const NodalState& nodes, const RigidBodies& rigid) {
  return side_velocity(c.sides[1], c.place, nodes.v, rigid) - side_velocity(c.sides[0], c.place, nodes.v, rigid);
}

// Velocity at the point per impulse there [1/kg].
Mat3 mobility(const ContactSide& side, const Vec3& place, const NodalState& nodes, const RigidBodies& rigid) {
  if (side.body != none) return inverse_mass_at(rigid.bodies[at(side.body)], place);
  double inverse = 0.0;
  for (std::size_t i = 0; i < 4; ++i) inverse += side.weights[i] * side.weights[i] / nodes.mass[at(side.nodes[i])];
  return inverse * Mat3::Identity();
}

void add_impulse(const ContactSide& side, const Vec3& place, const Vec3& impulse, NodalState& nodes,
                 RigidBodies& rigid) {
  if (side.body != none) {
    apply_impulse(rigid.bodies[at(side.body)], place, impulse);
    return;
  }
  for (std::size_t i = 0; i < 4; ++i)
    xyz(nodes.v[at(side.nodes[i])]) += side.weights[i] / nodes.mass[at(side.nodes[i])] * impulse;
}

// What the bodies are told of their contacts.
void note_approach(const Contact& c, double approach, RigidBodies& rigid) {
  for (const ContactSide& side : c.sides)
    if (side.body != none) rigid.approach[at(side.body)] = std::max(rigid.approach[at(side.body)], approach);
}

void note_push(const Contact& c, RigidBodies& rigid) {
  for (const ContactSide& side : c.sides)
    if (side.body != none) rigid.push[at(side.body)] += c.impulse.norm();
}

void add_impulse(const Contact& c, const Vec3& impulse, NodalState& nodes, RigidBodies& rigid) {
  add_impulse(c.sides[0], c.place, -impulse, nodes, rigid);
  add_impulse(c.sides[1], c.place, impulse, nodes, rigid);
}

double friction(const Contact& c, const ContactOptions& options) {
  const PairFriction& pairs = options.pairs;
  if (pairs.table.empty()) return options.friction;
  const Index first = pairs.particle_of_tet[at(c.tets[0])], second = pairs.particle_of_tet[at(c.tets[1])];
  return pairs.table[at(first * pairs.num_particles + second)];
}

/// What the sweeps need of a contact.
struct Row {
  double friction = 0.0;         ///< [-]
  double normal_mass = 0.0;      ///< [kg]
  double tangential_mass = 0.0;  ///< for the direction that moves most easily: the sweeps converge from below [kg]
  double target = 0.0;           ///< normal velocity to reach [m/s]
};

bool is_rigid(const Contact& c) { return c.sides[0].body != none || c.sides[1].body != none; }
bool is_between_bodies(const Contact& c) { return c.sides[0].body != none && c.sides[1].body != none; }

Row make_row(const Contact& c, const NodalState& nodes, RigidBodies& rigid, const ContactOptions& options) {
  const Mat3 both = mobility(c.sides[0], c.place, nodes, rigid) + mobility(c.sides[1], c.place, nodes, rigid);
  Row row;
  row.friction = friction(c, options);
  const double along = c.normal.dot(both * c.normal);
  row.normal_mass = 1.0 / along;
  if (is_rigid(c)) {
    // Of the mobility in the tangential plane, [a b; b d] for two tangents, the largest eigenvalue.
    const Vec3 s = c.normal.unitOrthogonal(), t = c.normal.cross(s);
    const double a = s.dot(both * s), b = s.dot(both * t), d = t.dot(both * t);
    row.tangential_mass = 1.0 / (0.5 * (a + d) + std::hypot(0.5 * (a - d), b));
  } else {
    row.tangential_mass = row.normal_mass;
  }
  const double approach = -c.normal.dot(relative_velocity(c, nodes, rigid));
  note_approach(c, approach, rigid);
  if (is_between_bodies(c) && approach > options.slowest) row.target = options.restitution * approach;
  return row;
}

// The impulse nearest to `trial` in the Coulomb cone about the normal.
Vec3 in_cone(const Vec3& trial, const Vec3& normal, double friction) {
  const double push = std::max(0.0, trial.dot(normal));
  Vec3 tangential = trial - trial.dot(normal) * normal;
  const double size = tangential.norm();
  if (size > friction * push) tangential *= friction * push / size;
  return push * normal + tangential;
}

// Solves one contact; returns the change of its velocity.
double solve(Contact& c, const Row& row, NodalState& nodes, RigidBodies& rigid) {
  const Vec3 velocity = relative_velocity(c, nodes, rigid);
  const double along = velocity.dot(c.normal);
  const Vec3 trial = c.impulse - row.normal_mass * (along - row.target) * c.normal -
                     row.tangential_mass * (velocity - along * c.normal);
  const Vec3 impulse = in_cone(trial, c.normal, row.friction);
  const Vec3 change = impulse - c.impulse;
  add_impulse(c, change, nodes, rigid);
  c.impulse = impulse;
  return change.norm() / row.normal_mass;
}

// Until nothing changes any more.
void settle_bodies(ContactState& contact, std::span<const Row> rows, NodalState& nodes, RigidBodies& rigid,
                   const ContactOptions& options) {
  std::vector<std::size_t> with_body;
  double fastest = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Contact& c = contact.contacts[i];
    if (!is_rigid(c)) continue;
    with_body.push_back(i);
    fastest = std::max({fastest, c.impulse.norm() / rows[i].normal_mass, rows[i].target});
  }
  for (int sweep = 0; sweep < options.rigid_sweeps; ++sweep) {
    double largest = 0.0;
    for (const std::size_t i : with_body)
      largest = std::max(largest, solve(contact.contacts[i], rows[i], nodes, rigid));
    if (largest <= settled * fastest) return;
  }
}

}  // namespace

void apply_contact_impulses(ContactState& contact, NodalState& nodes, RigidBodies& rigid,
                            const ContactOptions& options) {
  std::vector<Row> rows;
  rows.reserve(contact.contacts.size());
  for (const Contact& c : contact.contacts) rows.push_back(make_row(c, nodes, rigid, options));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    Contact& c = contact.contacts[i];
    c.impulse = in_cone(c.impulse, c.normal, rows[i].friction);
    add_impulse(c, c.impulse, nodes, rigid);
  }
  for (int sweep = 0; sweep < options.sweeps; ++sweep)
    for (std::size_t i = 0; i < rows.size(); ++i) solve(contact.contacts[i], rows[i], nodes, rigid);
  settle_bodies(contact, rows, nodes, rigid, options);
  for (const Contact& c : contact.contacts) note_push(c, rigid);
}

void book_contact_losses(ContactState& contact, const NodalState& nodes, const RigidBodies& rigid) {
  for (const Contact& c : contact.contacts) {
    if (c.impulse.isZero(0.0)) continue;
    const Vec3 before = side_velocity_before(c.sides[1], c.place, nodes, rigid) -
                        side_velocity_before(c.sides[0], c.place, nodes, rigid);
    contact.dissipated -= 0.5 * c.impulse.dot(relative_velocity(c, nodes, rigid) + before);
  }
}

}  // namespace knap
