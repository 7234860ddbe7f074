// A record passes through three regimes. Virgin: the impulse that keeps the faces together, within a capacity; a secant
// stiffness would be unstable as long as K w (1/m_a + 1/m_b) dt^2 is not small, so the record stays virgin until its
// opening passes the d_s at which it is. Softening: the secant force, explicit, plus contact. Failed: contact.
// The alternative, springs from the start, gains 15-65 % of the incident energy at insertion or costs the time step.
#include "cohesive/vertex_impulses.hpp"

#include <atomic>

#include "core/parallel.hpp"

namespace knap {
namespace {

constexpr Index vertices_per_block = 64;
// Virgin until K w (1/m_a + 1/m_b) dt^2 <= 1/3: about three records share a node, and the leapfrog limit is 4.
constexpr double virgin_stiffness_factor = 3.0;

// What the sweeps need of a record, gathered once a step.
struct Prepared {
  CrackRecord* record;
  Vec3 normal;
  Vec3 jump;
  double inverse_mass_a, inverse_mass_b;
  double effective_mass;
  double closing_speed;  // the gap may close by this much in the step: max(0, j_n)/dt
  double capacity;       // of tension, virgin records only [N s]
  double friction;
};

void advance_damage(CrackRecord& record, CrackFace& face, const Vec3& jump, const Vec3& normal, const Vec3& slip_before,
                    double virgin_limit, const VertexImpulseOptions& options, CrackLosses& losses, bool& damaged) {
  const CohesiveLaw& law = options.law;
  const double jn = jump.dot(normal);
  const Vec3 jt = jump - jn * normal;
  const double jt2 = jt.squaredNorm();
  const double d = std::sqrt(effective_opening2(law, jn, jt2));
  const double w = record.tributary_area;
  if (d > record.d_max) {
    const double grown = std::min(d, record.delta_c) - record.d_max;
    damaged = damaged || grown > 1e-6 * record.delta_c;
    if (record.regime == RecordRegime::Softening && grown > 0.0) {
      const double energy2 = energy_opening2(law, jn, jt2);
      const double spent = 0.5 * w * record.s0 * grown * energy2 / (d * d);
      const double shear_share = energy2 > 0.0 ? law.beta * law.beta / law.kappa * jt2 / energy2 : 0.0;
      record.dissipated += spent;
      record.dissipated_shear += spent * shear_share;
    }
    record.d_max = std::min(d, record.delta_c);
  }
  const bool leaves_virgin = record.regime == RecordRegime::Virgin && record.d_max > virgin_limit;
  if (leaves_virgin) record.regime = RecordRegime::Softening;
  if (record.d_max >= record.delta_c) {
    record.regime = RecordRegime::Failed;
    face.failed[record.corner] = 1;
  }
  if (record.regime != RecordRegime::Softening) {
    record.secant.setZero();
    return;
  }
  const double stiffness = secant_stiffness(record.s0, record.d_max, record.delta_c);
  record.secant = stiffness * (std::max(jn, 0.0) * normal + law.beta * law.beta / law.kappa * jt);
  if (leaves_virgin) {
    // The impulses of the virgin phase paid for the whole opening; from now on the state pays for the recoverable part,
    // and the half step from the last opening to this one is not in any sum yet.
    losses.cohesive -= 0.5 * w * stiffness * energy_opening2(law, jn, jt2);
    losses.cohesive += 0.5 * w * options.dt * record.secant.dot(slip_before);
  }
}

// The impulse nearest to `trial` that the record can bear: capacity in tension, Coulomb cone and cohesion in
// compression.
Vec3 admissible(const Prepared& p, double beta, double normal_part, Vec3 tangential) {
  double limit = 0.0;
  if (normal_part < 0.0) {
    normal_part = std::max(normal_part, -p.capacity);
    limit = beta * std::sqrt(std::max(0.0, p.capacity * p.capacity - normal_part * normal_part));
  } else {
    limit = beta * p.capacity + p.friction * normal_part;
  }
  const double size2 = tangential.squaredNorm();
  if (size2 > limit * limit) tangential *= limit / std::sqrt(size2);
  return normal_part * p.normal + tangential;
}

void add_impulse(const Prepared& p, const Vec3& impulse, NodalState& nodes) {
  xyz(nodes.v[at(p.record->node_a)]) -= p.inverse_mass_a * impulse;
  xyz(nodes.v[at(p.record->node_b)]) += p.inverse_mass_b * impulse;
}

Prepared prepare(CrackRecord& record, CrackFace& face, NodalState& nodes, const VertexImpulseOptions& options,
                 CrackLosses& losses, bool& damaged) {
  const std::size_t a = at(record.node_a), b = at(record.node_b);
  Prepared p;
  p.record = &record;
  p.normal = face.normal;
  p.jump = xyz(nodes.x[b]) - xyz(nodes.x[a]);
  p.inverse_mass_a = 1.0 / nodes.mass[a];
  p.inverse_mass_b = 1.0 / nodes.mass[b];
  p.effective_mass = 1.0 / (p.inverse_mass_a + p.inverse_mass_b);
  if (record.regime != RecordRegime::Failed) {
    const double virgin_limit =
        virgin_stiffness_factor * options.dt * options.dt * record.s0 * record.tributary_area / p.effective_mass;
    const Vec3 slip_before = xyz(nodes.v_before[b]) - xyz(nodes.v_before[a]);
    advance_damage(record, face, p.jump, p.normal, slip_before, virgin_limit, options, losses, damaged);
    if (record.regime == RecordRegime::Softening)
      add_impulse(p, -options.dt * record.tributary_area * record.secant, nodes);
  }
  p.closing_speed = std::max(0.0, p.jump.dot(p.normal)) / options.dt;
  const double damage = record.damage();
  p.capacity =
      record.regime == RecordRegime::Virgin ? options.dt * record.tributary_area * record.s0 * (1.0 - damage) : 0.0;
  p.friction = crack_friction(options.law, damage);
  return p;
}

void warm_start(Prepared& p, double beta, NodalState& nodes) {
  const double normal_part = p.record->impulse.dot(p.normal);
  const bool may_push = p.closing_speed == 0.0;
  p.record->impulse = admissible(p, beta, may_push ? normal_part : std::min(normal_part, 0.0),
                                 p.record->impulse - normal_part * p.normal);
  add_impulse(p, p.record->impulse, nodes);
}

void relax(Prepared& p, double beta, NodalState& nodes) {
  const Vec3 slip = xyz(nodes.v[at(p.record->node_b)]) - xyz(nodes.v[at(p.record->node_a)]);
  const double slip_n = slip.dot(p.normal);
  const double old_n = p.record->impulse.dot(p.normal);
  double normal_part = old_n - p.effective_mass * slip_n;
  if (normal_part > 0.0) normal_part = std::max(0.0, normal_part - p.effective_mass * p.closing_speed);
  const Vec3 tangential = (p.record->impulse - old_n * p.normal) - p.effective_mass * (slip - slip_n * p.normal);
  const Vec3 impulse = admissible(p, beta, normal_part, tangential);
  add_impulse(p, impulse - p.record->impulse, nodes);
  p.record->impulse = impulse;
}

bool solve_vertex(CrackState& cracks, NodalState& nodes, Index vertex, const VertexImpulseOptions& options,
                  std::vector<Prepared>& prepared) {
  bool damaged = false;
  prepared.clear();
  CrackLosses& losses = cracks.losses_of_vertex[at(vertex)];
  for (CrackRecord& record : cracks.records_of_vertex[at(vertex)]) {
    if (record.node_a == record.node_b) continue;
    prepared.push_back(prepare(record, cracks.faces[at(record.face)], nodes, options, losses, damaged));
  }
  for (Prepared& p : prepared) warm_start(p, options.law.beta, nodes);
  for (int sweep = 0; sweep < options.sweeps; ++sweep)
    for (Prepared& p : prepared) relax(p, options.law.beta, nodes);
  for (const Prepared& p : prepared) {
    const CrackRecord& record = *p.record;
    const Vec3 total = record.impulse - options.dt * record.tributary_area * record.secant;
    cracks.faces[at(record.face)].couple[record.corner] = p.jump.cross(total);
  }
  return damaged;
}

// Work taken from the bodies by an impulse on b (the opposite on a) at the mean slip of the step.
void book_record(const CrackRecord& record, const CrackFace& face, const Vec3& mean_slip,
                 const VertexImpulseOptions& options, CrackLosses& losses) {
  const double pn = record.impulse.dot(face.normal);
  const double slip_n = mean_slip.dot(face.normal);
  const double normal_loss = -pn * slip_n;
  const double tangential_loss = -(record.impulse.dot(mean_slip) - pn * slip_n);
  if (record.regime != RecordRegime::Virgin) {
    losses.closure += normal_loss;
    losses.friction += tangential_loss;
    return;
  }
  const double cohesion = options.law.beta * options.dt * record.tributary_area * record.s0 * (1.0 - record.damage());
  const double frictional = pn > 0.0 ? crack_friction(options.law, record.damage()) * pn : 0.0;
  const double friction_share = frictional > 0.0 ? frictional / (frictional + cohesion) : 0.0;
  losses.friction += friction_share * tangential_loss;
  losses.cohesive += (1.0 - friction_share) * tangential_loss;
  (pn > 0.0 ? losses.closure : losses.cohesive) += normal_loss;
}

Vec3 mean_velocity(const NodalState& nodes, Index node) {
  return 0.5 * (xyz(nodes.v[at(node)]) + xyz(nodes.v_before[at(node)]));
}

}  // namespace

bool apply_vertex_impulses(CrackState& cracks, NodalState& nodes, const VertexImpulseOptions& options) {
  std::atomic<bool> damaged{false};
  const Index count = to_index(cracks.vertices.size());
  parallel_blocks(num_blocks(count, vertices_per_block), [&](Index block) {
    std::vector<Prepared> prepared;
    const Index end = std::min(count, (block + 1) * vertices_per_block);
    bool any = false;
    for (Index i = block * vertices_per_block; i < end; ++i)
      any |= solve_vertex(cracks, nodes, cracks.vertices[at(i)], options, prepared);
    if (any) damaged.store(true, std::memory_order_relaxed);
  });
  return damaged.load();
}

void book_crack_losses(CrackState& cracks, const NodalState& nodes, const VertexImpulseOptions& options) {
  parallel_for(
      to_index(cracks.vertices.size()),
      [&](Index i) {
        const Index vertex = cracks.vertices[at(i)];
        CrackLosses& losses = cracks.losses_of_vertex[at(vertex)];
        for (const CrackRecord& record : cracks.records_of_vertex[at(vertex)]) {
          const CrackFace& face = cracks.faces[at(record.face)];
          if (record.node_a != record.node_b && record.impulse.squaredNorm() > 0.0)
            book_record(record, face, mean_velocity(nodes, record.node_b) - mean_velocity(nodes, record.node_a),
                        options, losses);
          if (face.rotation.squaredNorm() == 0.0) continue;
          for (const Index node : {record.node_a, record.node_b})
            losses.friction -=
                nodes.mass[at(node)] *
                face.rotation.cross(xyz(nodes.x[at(node)]) - face.centre).dot(mean_velocity(nodes, node));
        }
      },
      vertices_per_block);
}

CrackEnergies& CrackEnergies::operator+=(const CrackEnergies& other) {
  stored += other.stored;
  cohesive += other.cohesive;
  closure += other.closure;
  friction += other.friction;
  cohesive_shear += other.cohesive_shear;
  return *this;
}

CrackEnergies crack_energies(const CrackState& cracks, const NodalState& nodes, const VertexImpulseOptions& options) {
  return ordered_sum<CrackEnergies>(to_index(cracks.losses_of_vertex.size()), [&](Index vertex) {
    const CrackLosses& losses = cracks.losses_of_vertex[at(vertex)];
    CrackEnergies sum{0.0, losses.cohesive, losses.closure, losses.friction, losses.cohesive_shear};
    for (const CrackRecord& record : cracks.records_of_vertex[at(vertex)]) {
      sum.cohesive += record.dissipated;
      sum.cohesive_shear += record.dissipated_shear;
      if (record.regime != RecordRegime::Softening || record.node_a == record.node_b) continue;
      const std::size_t a = at(record.node_a), b = at(record.node_b);
      const Vec3 jump = xyz(nodes.x[b]) - xyz(nodes.x[a]);
      const Vec3 slip = xyz(nodes.v[b]) - xyz(nodes.v[a]);
      // The secant force is the gradient of K/2 (<jn>^2 + beta^2/kappa jt^2), so twice that is secant . jump with <jn>.
      const double jn = jump.dot(cracks.faces[at(record.face)].normal);
      const Vec3 opening = jump - std::min(jn, 0.0) * cracks.faces[at(record.face)].normal;
      sum.stored += 0.5 * record.tributary_area * record.secant.dot(opening + options.dt * slip);
    }
    return sum;
  });
}

}  // namespace knap
