#include "contact/contact_impulses.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"

namespace knap {
namespace {

// A contact has settled when a sweep changes its velocity by no more than this share of the largest change of the step.
constexpr double settled = 1e-6;
// ... or of the fastest body's speed: bodies that fly along in touch would else be settled to the last bit for ever.
constexpr double still = 1e-9;
constexpr Index rows_per_block = 256;
// The impulses between deformable tets have settled when a sweep changes them by this share, as a root of sums of
// squares.
constexpr double settled_impulses = 0.01;

Vec3 side_velocity(const ContactSide& side, const Vec3& place, const std::vector<Vec4>& v, const RigidBodies& rigid,
                   std::span<const Tool> tools) {
  if (side.body != none) return velocity_at(rigid.bodies[at(side.body)], place);
  if (side.tool != none) return tools[at(side.tool)].velocity_at(place);
  Vec4 sum = Vec4::Zero();
  for (std::size_t i = 0; i < 4; ++i) sum += side.weights[i] * v[at(side.nodes[i])];
  return xyz(sum);
}

// Of the second side relative to the first; no tools.
Vec3 relative_velocity_before(const Contact& c, const NodalState& nodes, const RigidBodies& rigid) {
  std::array<Vec3, 2> velocity;
  for (std::size_t k = 0; k < 2; ++k)
    velocity[k] = c.sides[k].body != none ? velocity_before_at(rigid.bodies[at(c.sides[k].body)], c.place)
                                          : side_velocity(c.sides[k], c.place, nodes.v_before, rigid, {});
  return velocity[1] - velocity[0];
}

Vec3 relative_velocity(const Contact& c, const ContactParties& all) {
  return relative_velocity(c, all.nodes, all.rigid, all.tools);
}

// Velocity at the point per impulse there [1/kg].
Mat3 mobility(const ContactSide& side, const Vec3& place, const ContactParties& all) {
  if (side.body != none) return inverse_mass_at(all.rigid.bodies[at(side.body)], place);
  if (side.tool != none) {
    const Tool& tool = all.tools[at(side.tool)];
    return tool.is_guided() ? Mat3(tool.guide * tool.guide.transpose() / tool.mass) : Mat3::Zero();
  }
  double inverse = 0.0;
  for (std::size_t i = 0; i < 4; ++i) inverse += side.weights[i] * side.weights[i] / all.nodes.mass[at(side.nodes[i])];
  return inverse * Mat3::Identity();
}

void push_tool(Tool& tool, const Vec3& impulse, double dt) {
  if (tool.is_guided())
    set_guided_speed(tool, tool.guide.dot(tool.state.velocity) + tool.guide.dot(impulse) / tool.mass, dt);
}

void add_impulse(const ContactSide& side, const Vec3& place, const Vec3& impulse, const ContactParties& all) {
  if (side.body != none) {
    apply_impulse(all.rigid.bodies[at(side.body)], place, impulse);
  } else if (side.tool != none) {
    push_tool(all.tools[at(side.tool)], impulse, all.dt);
  } else {
    for (std::size_t i = 0; i < 4; ++i)
      xyz(all.nodes.v[at(side.nodes[i])]) += side.weights[i] / all.nodes.mass[at(side.nodes[i])] * impulse;
  }
}

void add_impulse(const Contact& c, const Vec3& impulse, const ContactParties& all) {
  add_impulse(c.sides[0], c.place, -impulse, all);
  add_impulse(c.sides[1], c.place, impulse, all);
}

// What the bodies are told of their contacts.
void note_push(const Contact& c, RigidBodies& rigid) {
  for (const ContactSide& side : c.sides)
    if (side.body != none) rigid.push[at(side.body)] += c.total_impulse().norm();
}

double friction(const Contact& c, const ContactParties& all, const ContactOptions& options) {
  if (c.sides[0].tool != none) return all.tools[at(c.sides[0].tool)].friction;
  const PairFriction& pairs = options.pairs;
  if (pairs.table.empty()) return options.friction;
  const Index first = pairs.particle_of_tet[at(c.tets[0])], second = pairs.particle_of_tet[at(c.tets[1])];
  return pairs.table[at(first * pairs.num_particles + second)];
}

/// What the sweeps need of a contact. Most are of two deformable tets: all of these lies together, in vectors of four.
struct alignas(64) Row {
  Vec4 normal = Vec4::Zero();
  Vec4 impulse = Vec4::Zero();        ///< on the second side [N s]
  std::array<double, 8> weights{};    ///< of the nodes' velocities in that of the second side relative to the first [-]
  std::array<double, 8> mobility{};   ///< of the nodes: velocity per impulse [1/kg]
  std::array<Index, 8> nodes{};       ///< of the first and of the second side
  double friction = 0.0;              ///< [-]
  double normal_mass = 0.0;           ///< [kg]
  double tangential_mass = 0.0;       ///< for the direction that moves most easily: the sweeps converge from below [kg]
  double target = 0.0;                ///< normal velocity to reach [m/s]
  bool is_of_deformable_tets = true;  ///< else only friction, masses and target are used
};

bool is_rigid(const Contact& c) { return c.sides[0].body != none || c.sides[1].body != none; }
// Both sides are rigid.
bool can_rebound(const Contact& c) { return !c.sides[0].is_deformable() && !c.sides[1].is_deformable(); }

Row deformable_row(const Contact& c, const NodalState& nodes) {
  Row row;
  row.normal = padded(c.normal);
  row.impulse = padded(c.impulse);
  double inverse_mass = 0.0;
  for (std::size_t k = 0; k < 8; ++k) {
    const ContactSide& side = c.sides[k / 4];
    row.nodes[k] = side.nodes[k % 4];
    row.weights[k] = (k < 4 ? -1.0 : 1.0) * side.weights[k % 4];
    row.mobility[k] = row.weights[k] / nodes.mass[at(row.nodes[k])];
    inverse_mass += row.weights[k] * row.mobility[k];
  }
  row.normal_mass = row.tangential_mass = 1.0 / inverse_mass;
  return row;
}

Row rigid_row(const Contact& c, const ContactParties& all) {
  const Mat3 both = mobility(c.sides[0], c.place, all) + mobility(c.sides[1], c.place, all);
  Row row;
  row.is_of_deformable_tets = false;
  row.normal_mass = 1.0 / c.normal.dot(both * c.normal);
  // Of the mobility in the tangential plane, [a b; b d] for two tangents, the largest eigenvalue.
  const Vec3 s = c.normal.unitOrthogonal(), t = c.normal.cross(s);
  const double a = s.dot(both * s), b = s.dot(both * t), d = t.dot(both * t);
  row.tangential_mass = 1.0 / (0.5 * (a + d) + std::hypot(0.5 * (a - d), b));
  row.target = c.gap > 0.0 ? -c.gap / all.dt : 0.0;
  return row;
}

// Kept from step to step: the system takes time to give so much memory.
std::vector<Row>& workspace() {
  thread_local std::vector<Row> rows;
  return rows;
}

Row make_row(const Contact& c, const ContactParties& all, const ContactOptions& options) {
  Row row = is_rigid(c) ? rigid_row(c, all) : deformable_row(c, all.nodes);
  row.friction = friction(c, all, options);
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

// Solves a contact of a rigid body; returns the change of its velocity.
double solve(Contact& c, const Row& row, const ContactParties& all) {
  const Vec3 velocity = relative_velocity(c, all);
  const double along = velocity.dot(c.normal);
  const Vec3 trial = c.impulse - row.normal_mass * (along - row.target) * c.normal -
                     row.tangential_mass * (velocity - along * c.normal);
  const Vec3 impulse = in_cone(trial, c.normal, row.friction);
  const Vec3 change = impulse - c.impulse;
  add_impulse(c, change, all);
  c.impulse = impulse;
  return change.norm() / row.normal_mass;
}

double dot3(const Vec4& a, const Vec4& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vec4 in_cone(const Vec4& trial, const Row& row) {
  const double along = dot3(trial, row.normal);
  if (along <= 0.0) return Vec4::Zero();
  const Vec4 push = along * row.normal;
  const Vec4 drag = trial - push;
  const double size2 = dot3(drag, drag), limit = row.friction * along;
  if (size2 <= limit * limit) return trial;
  return push + limit / std::sqrt(size2) * drag;
}

void add_impulse(const Row& row, const Vec4& impulse, std::vector<Vec4>& v) {
  for (std::size_t k = 0; k < 8; ++k) v[at(row.nodes[k])] += row.mobility[k] * impulse;
}

// The same of two deformable tets; returns the change of its impulse, squared [N2 s2].
double solve(Row& row, std::vector<Vec4>& v) {
  Vec4 velocity = Vec4::Zero();
  for (std::size_t k = 0; k < 8; ++k) velocity += row.weights[k] * v[at(row.nodes[k])];
  if (row.impulse.isZero(0.0) && dot3(velocity, row.normal) >= 0.0) return 0.0;
  const Vec4 impulse = in_cone(row.impulse - row.normal_mass * velocity, row);
  const Vec4 change = impulse - row.impulse;
  add_impulse(row, change, v);
  row.impulse = impulse;
  return dot3(change, change);
}

// The row that a sweep solves as the k-th.
std::size_t turn(const std::vector<Row>& rows, std::size_t k, bool is_backwards) {
  return is_backwards ? rows.size() - 1 - k : k;
}

// The nodes of contacts lie anywhere in memory: asked for ahead. Inlined because GCC takes a function that only
// prefetches for one without effect.
[[gnu::always_inline]] inline void prefetch_nodes(const std::vector<Row>& rows, std::size_t k, bool is_backwards,
                                                  const std::vector<Vec4>& v) {
  constexpr std::size_t ahead = 6;
  if (k + ahead >= rows.size()) return;
  for (const Index node : rows[turn(rows, k + ahead, is_backwards)].nodes) __builtin_prefetch(&v[at(node)], 1);
}

// The impulses that the contacts begin with.
void warm_start(ContactState& contact, std::vector<Row>& rows, const ContactParties& all) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    prefetch_nodes(rows, i, false, all.nodes.v);
    Row& row = rows[i];
    Contact& c = contact.contacts[i];
    if (row.is_of_deformable_tets) {  // its impulse has been in the cone and turned with it
      if (!row.impulse.isZero(0.0)) add_impulse(row, row.impulse, all.nodes.v);
    } else {
      c.impulse = in_cone(c.impulse, c.normal, row.friction);
      add_impulse(c, c.impulse, all);
    }
  }
}

// Returns whether the impulses between deformable tets have settled: the sweep has changed them little.
bool sweep(ContactState& contact, std::vector<Row>& rows, bool is_backwards, const ContactParties& all) {
  double changes2 = 0.0, impulses2 = 0.0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    prefetch_nodes(rows, k, is_backwards, all.nodes.v);
    const std::size_t i = turn(rows, k, is_backwards);
    if (rows[i].is_of_deformable_tets) {
      changes2 += solve(rows[i], all.nodes.v);
      impulses2 += dot3(rows[i].impulse, rows[i].impulse);
    } else {
      solve(contact.contacts[i], rows[i], all);
    }
  }
  return changes2 <= settled_impulses * settled_impulses * impulses2;
}

// Impacts of rigid bodies one after the other, each at the velocities that those before have left, until none
// approaches any more (Guendelman, Bridson & Fedkiw 2003): each keeps the energy for e = 1 and loses some for e < 1,
// which the simultaneous law does only at its exact solution. What still approaches then is stopped without rebound.
void let_rebound(ContactState& contact, std::span<const Row> rows, const ContactParties& all,
                 const ContactOptions& options) {
  if (options.restitution == 0.0) return;
  for (int round = 0; round < options.rebounds; ++round) {
    bool any = false;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      Contact& c = contact.contacts[i];
      if (!can_rebound(c)) continue;
      const Vec3 velocity = relative_velocity(c, all);
      const double along = velocity.dot(c.normal);
      if (along >= rows[i].target || -along <= options.slowest) continue;
      const double push = -(1.0 + options.restitution) * rows[i].normal_mass * along;
      const Vec3 stop = -rows[i].tangential_mass * (velocity - along * c.normal);
      const Vec3 impulse = in_cone(push * c.normal + stop, c.normal, rows[i].friction);
      add_impulse(c, impulse, all);
      c.rebound += impulse;
      any = true;
    }
    if (!any) return;
  }
}

// Until nothing changes any more; in each sweep only the contacts of bodies that the one before has moved.
void settle_bodies(ContactState& contact, std::span<const Row> rows, const ContactParties& all,
                   const ContactOptions& options) {
  std::vector<std::size_t> with_body;
  double fastest = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Contact& c = contact.contacts[i];
    if (!is_rigid(c)) continue;
    with_body.push_back(i);
    fastest = std::max(fastest, c.impulse.norm() / rows[i].normal_mass);
  }
  double speed = 0.0;
  for (const RigidBody& body : all.rigid.bodies) speed = std::max(speed, body.velocity.norm());
  const double negligible = std::max(settled * fastest, still * speed);
  std::vector<std::uint8_t> moved(all.rigid.bodies.size(), 1), moves(moved.size());
  for (int sweep = 0; sweep < options.rigid_sweeps; ++sweep) {
    std::fill(moves.begin(), moves.end(), 0);
    for (const std::size_t i : with_body) {
      Contact& c = contact.contacts[i];
      const auto has_moved = [&](const ContactSide& side) {
        return side.body != none && (moved[at(side.body)] != 0 || moves[at(side.body)] != 0);
      };
      if (!has_moved(c.sides[0]) && !has_moved(c.sides[1])) continue;
      if (solve(c, rows[i], all) <= negligible) continue;
      for (const ContactSide& side : c.sides)
        if (side.body != none) moves[at(side.body)] = 1;
    }
    if (std::count(moves.begin(), moves.end(), 1) == 0) return;
    std::swap(moved, moves);
  }
}

}  // namespace

Vec3 relative_velocity(const Contact& c, const NodalState& nodes, const RigidBodies& rigid,
                       std::span<const Tool> tools) {
  return side_velocity(c.sides[1], c.place, nodes.v, rigid, tools) -
         side_velocity(c.sides[0], c.place, nodes.v, rigid, tools);
}

void apply_contact_impulses(ContactState& contact, const ContactParties& all, const ContactOptions& options) {
  std::vector<Row>& rows = workspace();
  rows.resize(contact.contacts.size());
  parallel_for(
      to_index(rows.size()), [&](Index i) { rows[at(i)] = make_row(contact.contacts[at(i)], all, options); },
      rows_per_block);
  let_rebound(contact, rows, all, options);
  warm_start(contact, rows, all);
  // Always in the same direction they are biased by the order: a large contact then loses friction, and a rebound gains
  // energy.
  for (int i = 0; i < std::max(options.sweeps, options.most_sweeps); ++i)
    if (sweep(contact, rows, (all.step + i) % 2 != 0, all) && i + 1 >= options.sweeps) break;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].is_of_deformable_tets) contact.contacts[i].impulse = xyz(rows[i].impulse);
  settle_bodies(contact, rows, all, options);
  for (const Contact& c : contact.contacts) note_push(c, all.rigid);
}

void book_contact_losses(ContactState& contact, const NodalState& nodes, const RigidBodies& rigid) {
  contact.dissipated -= ordered_sum<double>(to_index(contact.contacts.size()), [&](Index i) {
    const Contact& c = contact.contacts[at(i)];
    const Vec3 impulse = c.total_impulse();
    if (impulse.isZero(0.0) || c.is_of_tool()) return 0.0;
    return 0.5 * impulse.dot(relative_velocity(c, nodes, rigid, {}) + relative_velocity_before(c, nodes, rigid));
  });
}

std::vector<ToolDeed> tool_deeds(const ContactState& contact, const RigidBodies& rigid, std::span<const Tool> tools) {
  std::vector<ToolDeed> deeds;
  for (const Contact& c : contact.contacts) {
    const Vec3 impulse = c.total_impulse();
    if (c.sides[0].tool == none || impulse.isZero(0.0)) continue;
    const RigidBody& body = rigid.bodies[at(c.sides[1].body)];
    const Vec3 push = impulse.dot(c.normal) * c.normal;
    const Vec3 mean = 0.5 * (velocity_at(body, c.place) + velocity_before_at(body, c.place));
    const Index tool = c.sides[0].tool;
    deeds.push_back({tool, c.place, tools[at(tool)].state.position, push, impulse - push, mean, c.place});
  }
  return deeds;
}

}  // namespace knap
