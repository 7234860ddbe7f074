// A record passes through three regimes. Virgin: the impulse that keeps the faces together, within a capacity; a secant
// stiffness would be unstable as long as K w (1/m_a + 1/m_b) dt^2 is not small, so the record stays virgin until its
// opening passes the d_s at which it is. Softening: the secant force, explicit, plus contact. Failed: contact.
// The alternative, springs from the start, gains 15-65 % of the incident energy at insertion or costs the time step.
#include "cohesive/vertex_impulses.hpp"

#include <atomic>
#include <cstddef>

#include "core/parallel.hpp"

namespace knap {
namespace {

constexpr Index vertices_per_block = 32;
// Virgin until K w (1/m_a + 1/m_b) dt^2 <= 1/3: about three records share a node, and the leapfrog limit is 4.
constexpr double virgin_stiffness_factor = 3.0;
// Damage that grows by less than this in a step does not keep an automatic run from stopping.
constexpr double noticeable_damage = 1e-5;

/// What the sweeps need of a record, gathered once a step.
struct Prepared {
  CrackRecord* record;
  Vec4* velocity_a;
  Vec4* velocity_b;
  Vec3 normal;
  Vec3 jump;
  Vec3 secant_impulse;
  double inverse_mass_a, inverse_mass_b;
  double effective_mass;
  double closing_speed;  // the gap may close by this much in the step: max(0, j_n)/dt
  double capacity;       // of tension, virgin records only [N s]
  double friction;
};

/// A jump of a record, split along the normal of its face.
struct Opening {
  double normal;    // [m]
  Vec3 tangential;  // [m]
  double tangential2;

  Opening(const Vec3& jump, const Vec3& n)
      : normal(jump.dot(n)), tangential(jump - normal * n), tangential2(tangential.squaredNorm()) {}
};

/// Traction [Pa] with which a softening record pulls its sides together at an opening.
Vec3 secant_traction(const CohesiveLaw& law, const CrackRecord& record, const Opening& opening, const Vec3& n) {
  return secant_stiffness(record.s0, record.d_max, record.delta_c) *
         (std::max(opening.normal, 0.0) * n + law.beta * law.beta / law.kappa * opening.tangential);
}

/// Raises d_max to the present opening and books what that spends once the record softens. Returns the growth [m].
double grow_damage(const CohesiveLaw& law, CrackRecord& record, const Opening& opening, CrackLosses& losses) {
  const double d2 = effective_opening2(law, opening.normal, opening.tangential2);
  if (d2 <= record.d_max * record.d_max) return 0.0;
  const double reached = std::min(std::sqrt(d2), record.delta_c);
  const double grown = std::max(0.0, reached - record.d_max);
  if (record.regime == RecordRegime::Softening) {
    const double energy2 = energy_opening2(law, opening.normal, opening.tangential2);
    const double spent = 0.5 * record.tributary_area * record.s0 * grown * energy2 / d2;
    losses.cohesive += spent;
    losses.cohesive_shear += spent * law.beta * law.beta / law.kappa * opening.tangential2 / energy2;
  }
  record.d_max = reached;
  return grown;
}

/// Advances the regime of a record and returns the secant traction of this step. `slip` is the velocity of the jump
/// before the step, `virgin_limit` the opening from which the secant stiffness is harmless.
Vec3 advance_regime(CrackRecord& record, CrackFace& face, const Opening& opening, const Vec3& slip, double virgin_limit,
                    const VertexImpulseOptions& options, CrackLosses& losses) {
  const bool leaves_virgin = record.regime == RecordRegime::Virgin && record.d_max > virgin_limit;
  if (leaves_virgin) record.regime = RecordRegime::Softening;
  if (record.d_max >= record.delta_c) {
    record.regime = RecordRegime::Failed;
    face.failed[record.corner] = 1;
  }
  if (record.regime != RecordRegime::Softening) return Vec3::Zero();
  const Vec3 traction = secant_traction(options.law, record, opening, face.normal);
  if (leaves_virgin) {
    // The impulses of the virgin phase paid for the whole opening; from now on the state pays for the recoverable part,
    // and the half step from the last opening to this one is not in any sum yet.
    const double stiffness = secant_stiffness(record.s0, record.d_max, record.delta_c);
    const double stored = 0.5 * stiffness * energy_opening2(options.law, opening.normal, opening.tangential2);
    losses.cohesive += record.tributary_area * (0.5 * options.dt * traction.dot(slip) - stored);
  }
  return traction;
}

/// The impulse nearest to (normal_part, tangential) that the record can bear: capacity in tension, Coulomb cone and
/// cohesion in compression.
[[gnu::always_inline]] inline Vec3 admissible(const Prepared& p, double beta, double normal_part,
                                              const Vec3& tangential) {
  double limit2 = 0.0;
  if (normal_part < 0.0) {
    normal_part = std::max(normal_part, -p.capacity);
    limit2 = beta * beta * (p.capacity * p.capacity - normal_part * normal_part);
  } else {
    const double limit = beta * p.capacity + p.friction * normal_part;
    limit2 = limit * limit;
  }
  const double size2 = tangential.squaredNorm();
  const double scale = size2 > limit2 ? std::sqrt(limit2 / size2) : 1.0;
  return normal_part * p.normal + scale * tangential;
}

[[gnu::always_inline]] inline void add_impulse(const Prepared& p, const Vec3& impulse) {
  xyz(*p.velocity_a) -= p.inverse_mass_a * impulse;
  xyz(*p.velocity_b) += p.inverse_mass_b * impulse;
}

Prepared prepare(CrackRecord& record, CrackFace& face, NodalState& nodes, const VertexImpulseOptions& options,
                 CrackLosses& losses, bool& damaged) {
  const std::size_t a = at(record.node_a), b = at(record.node_b);
  Prepared p;
  p.record = &record;
  p.velocity_a = &nodes.v[a];
  p.velocity_b = &nodes.v[b];
  p.normal = face.normal;
  p.jump = xyz(nodes.x[b]) - xyz(nodes.x[a]);
  p.inverse_mass_a = 1.0 / nodes.mass[a];
  p.inverse_mass_b = 1.0 / nodes.mass[b];
  p.effective_mass = 1.0 / (p.inverse_mass_a + p.inverse_mass_b);
  p.secant_impulse.setZero();
  p.capacity = 0.0;
  const double w_dt = options.dt * record.tributary_area;
  if (record.regime == RecordRegime::Failed) {
    p.closing_speed = std::max(0.0, p.jump.dot(p.normal)) / options.dt;
    p.friction = options.law.sliding_friction;
    return p;
  }
  const Opening opening(p.jump, p.normal);
  damaged |= grow_damage(options.law, record, opening, losses) > noticeable_damage * record.delta_c;
  const double virgin_limit = virgin_stiffness_factor * options.dt * w_dt * record.s0 / p.effective_mass;
  const Vec3 slip = xyz(nodes.v_before[b]) - xyz(nodes.v_before[a]);
  p.secant_impulse = -w_dt * advance_regime(record, face, opening, slip, virgin_limit, options, losses);
  p.closing_speed = std::max(0.0, opening.normal) / options.dt;
  if (record.regime == RecordRegime::Virgin) p.capacity = w_dt * record.s0 * (1.0 - record.damage());
  p.friction = crack_friction(options.law, record.damage());
  return p;
}

void warm_start(Prepared& p, double beta) {
  const double normal_part = p.record->impulse.dot(p.normal);
  // A push starts smaller by what the gap still lets through: continuous in the gap, which round-off may open.
  const double kept = normal_part > 0.0 ? std::max(0.0, normal_part - p.effective_mass * p.closing_speed) : normal_part;
  p.record->impulse = admissible(p, beta, kept, p.record->impulse - normal_part * p.normal);
  add_impulse(p, p.record->impulse + p.secant_impulse);
}

void relax(Prepared& p, double beta) {
  const Vec3 slip = xyz(*p.velocity_b) - xyz(*p.velocity_a);
  const Vec3 trial = p.record->impulse - p.effective_mass * slip;
  const double trial_n = trial.dot(p.normal);
  // A push only once the gap has closed.
  const double normal_part = trial_n > 0.0 ? std::max(0.0, trial_n - p.effective_mass * p.closing_speed) : trial_n;
  const Vec3 impulse = admissible(p, beta, normal_part, trial - trial_n * p.normal);
  add_impulse(p, impulse - p.record->impulse);
  p.record->impulse = impulse;
}

inline Vec3 mean_velocity(const NodalState& nodes, Index node) {
  return 0.5 * (xyz(nodes.v[at(node)]) + xyz(nodes.v_before[at(node)]));
}

Vec3 rotation_velocity(const CrackFace& face, const NodalState& nodes, Index node) {
  return face.rotation.cross(xyz(nodes.x[at(node)]) - face.centre);
}

/// Work taken from the bodies by an impulse on b (the opposite on a) at the mean velocities of the step.
void book_record(const CrackRecord& record, const CrackFace& face, const NodalState& nodes,
                 const VertexImpulseOptions& options, CrackLosses& losses) {
  if (face.rotates)
    for (const Index node : {record.node_a, record.node_b})
      losses.friction -= nodes.mass[at(node)] * rotation_velocity(face, nodes, node).dot(mean_velocity(nodes, node));
  if (record.is_closed_tip()) return;
  const Vec3 mean_slip = mean_velocity(nodes, record.node_b) - mean_velocity(nodes, record.node_a);
  const double pn = record.impulse.dot(face.normal);
  const double normal_loss = -pn * mean_slip.dot(face.normal);
  const double tangential_loss = -record.impulse.dot(mean_slip) - normal_loss;
  if (record.regime != RecordRegime::Virgin) {
    losses.closure += normal_loss;
    losses.friction += tangential_loss;
    return;
  }
  const double cohesion = options.law.beta * options.dt * record.tributary_area * record.s0 * (1.0 - record.damage());
  const double frictional = std::max(0.0, pn) * crack_friction(options.law, record.damage());
  const double friction_share = frictional > 0.0 ? frictional / (frictional + cohesion) : 0.0;
  losses.friction += friction_share * tangential_loss;
  losses.cohesive += (1.0 - friction_share) * tangential_loss;
  (pn > 0.0 ? losses.closure : losses.cohesive) += normal_loss;
}

CrackLosses impulse_losses(const CrackState& cracks, const NodalState& nodes, Index vertex,
                           const VertexImpulseOptions& options) {
  CrackLosses losses;
  for (const CrackRecord& record : cracks.records_of_vertex(vertex))
    book_record(record, cracks.faces[at(record.face)], nodes, options, losses);
  return losses;
}

void give_back_angular_momentum(const CrackState& cracks, NodalState& nodes, Index vertex) {
  for (const CrackRecord& record : cracks.records_of_vertex(vertex)) {
    const CrackFace& face = cracks.faces[at(record.face)];
    if (!face.rotates) continue;
    for (const Index node : {record.node_a, record.node_b})
      xyz(nodes.v[at(node)]) += rotation_velocity(face, nodes, node);
  }
}

// The faces and nodes of a vertex lie anywhere in memory: asked for one vertex ahead, they come while this one is
// solved.
void prefetch_vertex(const CrackState& cracks, const NodalState& nodes, Index vertex) {
  for (const CrackRecord& record : cracks.records_of_vertex(vertex)) {
    const auto* face = reinterpret_cast<const char*>(&cracks.faces[at(record.face)]);
    __builtin_prefetch(face, 1);
    __builtin_prefetch(face + offsetof(CrackFace, couple) + record.corner * sizeof(Vec3), 1);
    for (const Index node : {record.node_a, record.node_b}) {
      __builtin_prefetch(&nodes.v[at(node)], 1);
      __builtin_prefetch(&nodes.x[at(node)]);
      __builtin_prefetch(&nodes.v_before[at(node)]);
      __builtin_prefetch(&nodes.mass[at(node)]);
    }
  }
}

bool solve_vertex(CrackState& cracks, NodalState& nodes, Index vertex, const VertexImpulseOptions& options,
                  std::vector<Prepared>& prepared) {
  bool damaged = false;
  prepared.clear();
  give_back_angular_momentum(cracks, nodes, vertex);
  CrackLosses& losses = cracks.losses_of_vertex[at(vertex)];
  for (CrackRecord& record : cracks.records_of_vertex(vertex)) {
    CrackFace& face = cracks.faces[at(record.face)];
    if (face.ended) record.impulse.setZero();
    if (face.ended || record.is_closed_tip()) continue;
    prepared.push_back(prepare(record, face, nodes, options, losses, damaged));
  }
  for (Prepared& p : prepared) warm_start(p, options.law.beta);
  for (int sweep = 0; sweep < options.sweeps; ++sweep)
    for (Prepared& p : prepared) relax(p, options.law.beta);
  for (const Prepared& p : prepared)
    cracks.faces[at(p.record->face)].couple[p.record->corner] += p.jump.cross(p.record->impulse + p.secant_impulse);
  cracks.step_losses_of_vertex[at(vertex)] = impulse_losses(cracks, nodes, vertex, options);
  return damaged;
}

}  // namespace

bool apply_vertex_impulses(CrackState& cracks, NodalState& nodes, const VertexImpulseOptions& options) {
  std::atomic<bool> damaged{false};
  const Index count = to_index(cracks.vertices.size());
  parallel_blocks(num_blocks(count, vertices_per_block), [&](Index block) {
    thread_local std::vector<Prepared> prepared;
    const Index end = std::min(count, (block + 1) * vertices_per_block);
    bool any = false;
    for (Index i = block * vertices_per_block; i < end; ++i) {
      if (i + 1 < count) prefetch_vertex(cracks, nodes, cracks.vertices[at(i + 1)]);
      any |= solve_vertex(cracks, nodes, cracks.vertices[at(i)], options, prepared);
    }
    if (any) damaged.store(true, std::memory_order_relaxed);
  });
  return damaged.load();
}

void settle_crack_losses(CrackState& cracks, const Topology& topology, const NodalState& nodes,
                         std::vector<Index> changed_nodes, const VertexImpulseOptions& options) {
  for (Index& node : changed_nodes) node = topology.vertex_of_node[at(node)];
  std::sort(changed_nodes.begin(), changed_nodes.end());
  changed_nodes.erase(std::unique(changed_nodes.begin(), changed_nodes.end()), changed_nodes.end());
  for (const Index vertex : changed_nodes)
    if (!cracks.records_of_vertex(vertex).empty())
      cracks.step_losses_of_vertex[at(vertex)] = impulse_losses(cracks, nodes, vertex, options);
  for (const Index vertex : cracks.vertices)
    cracks.losses_of_vertex[at(vertex)] += cracks.step_losses_of_vertex[at(vertex)];
}

CrackEnergies& CrackEnergies::operator+=(const CrackEnergies& other) {
  stored += other.stored;
  losses += other.losses;
  return *this;
}

CrackEnergies crack_energies(const CrackState& cracks, const NodalState& nodes, const VertexImpulseOptions& options) {
  return ordered_sum<CrackEnergies>(to_index(cracks.losses_of_vertex.size()), [&](Index vertex) {
    CrackEnergies sum{0.0, cracks.losses_of_vertex[at(vertex)]};
    for (const CrackRecord& record : cracks.records_of_vertex(vertex)) {
      if (record.regime != RecordRegime::Softening || record.is_closed_tip()) continue;
      const std::size_t a = at(record.node_a), b = at(record.node_b);
      const Vec3& n = cracks.faces[at(record.face)].normal;
      const Vec3 jump = xyz(nodes.x[b]) - xyz(nodes.x[a]);
      const Vec3 slip = xyz(nodes.v[b]) - xyz(nodes.v[a]);
      const Opening opening(jump, n);
      const double stiffness = secant_stiffness(record.s0, record.d_max, record.delta_c);
      sum.stored += 0.5 * record.tributary_area *
                    (stiffness * energy_opening2(options.law, opening.normal, opening.tangential2) +
                     options.dt * secant_traction(options.law, record, opening, n).dot(slip));
    }
    return sum;
  });
}

}  // namespace knap
