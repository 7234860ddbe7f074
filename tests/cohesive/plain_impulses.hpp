#pragma once
// The vertex impulses once more, one record after the other in plain scalars, from the published law: Moreau's
// non-smooth dynamics with an initially rigid cohesive capacity, then linear softening (Camacho & Ortiz 1996; kappa
// after Snozzi & Molinari 2013). The law's own functions are those of linear_softening.hpp, whose work of separation is
// tested there. Sums of magnitudes beside the results tell what round-off to expect.
#include "cohesive/vertex_impulses.hpp"

namespace knap::plain {

struct Face {
  Vec3 normal;
  bool ended = false, rotates = false;
  Vec3 rotation, centre;
  std::array<Vec3, 3> couple;
  std::array<bool, 3> failed{};
};

struct Record {
  Vec3 impulse;     ///< on b [N s]
  double d_max;     ///< [m]
  double strength;  ///< s0 times the tributary area [N]
  double delta_c;   ///< [m]
  std::size_t face, a, b;
  std::size_t corner;
  RecordRegime regime;
};

/// What a record met in a step, to see that a test meets all of it.
struct Met {
  bool leaves_virgin = false, fails = false, grows = false;
  bool tension = false, pushes = false, slides = false, sticks = false, idle = false, spins = false;
};

struct State {
  double dt;
  int sweeps;
  CohesiveLaw law;
  std::vector<Face> faces;
  std::vector<std::vector<Record>> records_of_vertex;
  std::vector<Vec3> x, v, v_before;
  std::vector<double> mass;
  std::vector<CrackLosses> losses, step_losses;
  std::vector<double> loss_size;                ///< of a vertex, sum of the magnitudes of all terms [J]
  std::vector<std::vector<Met>> met_of_vertex;  ///< in the last step
};

/// A record in the midst of its step.
struct Solving {
  Record* record;
  bool acts;              ///< not ended, not a closed tip
  double effective_mass;  ///< [kg]
  double free_closing;    ///< impulse that the gap lets through [N s]
  double capacity;        ///< of tension [N s]
  double friction;
  Vec3 jump, secant;
};

inline void add_loss(State& s, std::size_t vertex, double& term, double loss) {
  term += loss;
  s.loss_size[vertex] += std::abs(loss);
}

// Damage: d_max follows the effective opening; where the record softens, the triangle between the old and the new
// unloading line is lost, 1/2 s0 dd times the conjugate opening over d^2.
inline void grow(State& s, std::size_t vertex, Record& r, double jn, const Vec3& jt, Met& met) {
  const CohesiveLaw& law = s.law;
  const double d = std::sqrt(effective_opening2(law, jn, jt.squaredNorm()));
  if (d <= r.d_max) return;
  met.grows = true;
  const double reached = d < r.delta_c ? d : r.delta_c;
  const double grown = std::max(0.0, reached - r.d_max);
  if (r.regime == RecordRegime::Softening) {
    const double in_shear = law.beta * law.beta / law.kappa * jt.squaredNorm();
    const double rate = 0.5 * r.strength * grown / (d * d);
    add_loss(s, vertex, s.losses[vertex].cohesive, rate * energy_opening2(law, jn, jt.squaredNorm()));
    s.losses[vertex].cohesive_shear += rate * in_shear;
  }
  r.d_max = reached;
}

// Virgin until the secant stiffness has come down to K (1/m_a + 1/m_b) dt^2 = 1/3.
inline void change_regime(const State& s, Record& r, Face& face, Met& met) {
  const double virgin_opening = 3.0 * s.dt * s.dt * r.strength * (1.0 / s.mass[r.a] + 1.0 / s.mass[r.b]);
  if (r.regime == RecordRegime::Virgin && r.d_max > virgin_opening) {
    met.leaves_virgin = true;
    r.regime = RecordRegime::Softening;
  }
  if (r.regime != RecordRegime::Failed && r.d_max >= r.delta_c) {
    met.fails = true;
    r.regime = RecordRegime::Failed;
    face.failed[r.corner] = true;
  }
}

// The secant force of linear softening as an impulse on b, and what its start takes off the losses: the virgin phase
// has paid for what is now recoverable, and half a step's opening is in no sum yet.
inline Vec3 secant_impulse(State& s, std::size_t vertex, const Record& r, const Vec3& n, double jn, const Vec3& jt,
                           bool starts) {
  const double mode = s.law.beta * s.law.beta / s.law.kappa;
  const double stiffness = secant_stiffness(r.strength, r.d_max, r.delta_c);
  const Vec3 force = -stiffness * (std::max(0.0, jn) * n + mode * jt);
  if (starts) {
    const double stored = 0.5 * stiffness * energy_opening2(s.law, jn, jt.squaredNorm());
    const double half_step = 0.5 * s.dt * force.dot(s.v_before[r.b] - s.v_before[r.a]);
    add_loss(s, vertex, s.losses[vertex].cohesive, -stored);
    add_loss(s, vertex, s.losses[vertex].cohesive, -half_step);
  }
  return s.dt * force;
}

inline double tension_capacity(const State& s, const Record& r) {
  if (r.regime != RecordRegime::Virgin) return 0.0;
  return s.dt * r.strength * (1.0 - std::min(1.0, r.d_max / r.delta_c));
}

// -p_n <= cap; |p_t| <= beta sqrt(cap^2 - p_n^2) in tension, beta cap + mu p_n in compression.
inline Vec3 admissible(const State& s, const Solving& q, const Vec3& n, double pn, const Vec3& pt, Met& met) {
  const double bounded = std::max(pn, -q.capacity);
  const double limit = bounded < 0.0 ? s.law.beta * std::sqrt((q.capacity - bounded) * (q.capacity + bounded))
                                     : s.law.beta * q.capacity + q.friction * bounded;
  met.tension = bounded < 0.0;
  met.pushes = bounded > 0.0;
  met.slides = pt.norm() > limit;
  met.sticks = !met.slides && bounded != 0.0;
  return bounded * n + (met.slides ? Vec3(limit / pt.norm() * pt) : pt);
}

// A push is what is left when the gap has closed.
inline double after_closing(double pn, double free_closing) { return pn > 0.0 ? std::max(0.0, pn - free_closing) : pn; }

inline void add_impulse(State& s, const Record& r, const Vec3& p) {
  s.v[r.a] -= p / s.mass[r.a];
  s.v[r.b] += p / s.mass[r.b];
}

inline Vec3 rotation_velocity(const State& s, const Face& face, std::size_t node) {
  return face.rotation.cross(s.x[node] - face.centre);
}

inline Solving start(State& s, std::size_t vertex, Record& r, Met& met) {
  Face& face = s.faces[r.face];
  Solving q{.record = &r,
            .acts = !face.ended && r.a != r.b,
            .effective_mass = 0.0,
            .free_closing = 0.0,
            .capacity = 0.0,
            .friction = 0.0,
            .jump = s.x[r.b] - s.x[r.a],
            .secant = Vec3::Zero()};
  met.idle = !q.acts;
  met.spins = face.rotates;
  const Vec3 last = r.impulse;
  r.impulse = Vec3::Zero();
  if (q.acts) {
    const double jn = q.jump.dot(face.normal);
    const Vec3 jt = q.jump - jn * face.normal;
    q.effective_mass = 1.0 / (1.0 / s.mass[r.a] + 1.0 / s.mass[r.b]);
    q.free_closing = q.effective_mass * std::max(0.0, jn) / s.dt;
    if (r.regime != RecordRegime::Failed) {
      grow(s, vertex, r, jn, jt, met);
      change_regime(s, r, face, met);
    }
    if (r.regime == RecordRegime::Softening)
      q.secant = secant_impulse(s, vertex, r, face.normal, jn, jt, met.leaves_virgin);
    q.capacity = tension_capacity(s, r);
    q.friction = crack_friction(s.law, std::min(1.0, r.d_max / r.delta_c));
    const double pn = last.dot(face.normal);
    r.impulse = admissible(s, q, face.normal, after_closing(pn, q.free_closing), last - pn * face.normal, met);
    add_impulse(s, r, r.impulse + q.secant);
  }
  if (face.rotates) {
    const Vec3 at_a = rotation_velocity(s, face, r.a), at_b = rotation_velocity(s, face, r.b);
    s.v[r.a] += at_a;
    s.v[r.b] += at_b;
  }
  return q;
}

inline void relax(State& s, const Solving& q, Met& met) {
  if (!q.acts) return;
  const Vec3& n = s.faces[q.record->face].normal;
  const Vec3 last = q.record->impulse;
  const Vec3 trial = last - q.effective_mass * (s.v[q.record->b] - s.v[q.record->a]);
  const double pn = trial.dot(n);
  q.record->impulse = admissible(s, q, n, after_closing(pn, q.free_closing), trial - pn * n, met);
  add_impulse(s, *q.record, q.record->impulse - last);
}

// What impulse and rotation take from the bodies at mean velocities: pulls and the cohesive share of shear are work of
// separation, a push that meets a closing face is an impact, the rest is friction.
inline void book(State& s, std::size_t vertex, const Record& r) {
  const Face& face = s.faces[r.face];
  CrackLosses& losses = s.step_losses[vertex];
  const Vec3 mean_a = 0.5 * (s.v_before[r.a] + s.v[r.a]), mean_b = 0.5 * (s.v_before[r.b] + s.v[r.b]);
  if (face.rotates) {
    add_loss(s, vertex, losses.friction, -s.mass[r.a] * rotation_velocity(s, face, r.a).dot(mean_a));
    add_loss(s, vertex, losses.friction, -s.mass[r.b] * rotation_velocity(s, face, r.b).dot(mean_b));
  }
  const Vec3 slip = mean_b - mean_a;
  const double pn = r.impulse.dot(face.normal);
  const Vec3 pt = r.impulse - pn * face.normal;
  const bool virgin = r.regime == RecordRegime::Virgin;
  add_loss(s, vertex, virgin && pn <= 0.0 ? losses.cohesive : losses.closure, -pn * slip.dot(face.normal));
  const double from_friction = crack_friction(s.law, std::min(1.0, r.d_max / r.delta_c)) * std::max(0.0, pn);
  const double from_cohesion = s.law.beta * tension_capacity(s, r);
  const double share = !virgin ? 1.0 : from_friction > 0.0 ? from_friction / (from_friction + from_cohesion) : 0.0;
  add_loss(s, vertex, losses.friction, -share * pt.dot(slip));
  add_loss(s, vertex, losses.cohesive, -(1.0 - share) * pt.dot(slip));
  s.loss_size[vertex] += r.impulse.norm() * (mean_a.norm() + mean_b.norm());  // of which the sums above may be little
}

/// One step of all vertices.
inline void apply_impulses(State& s) {
  s.met_of_vertex.assign(s.records_of_vertex.size(), {});
  for (std::size_t vertex = 0; vertex < s.records_of_vertex.size(); ++vertex) {
    std::vector<Record>& records = s.records_of_vertex[vertex];
    if (records.empty()) continue;
    std::vector<Met>& met = s.met_of_vertex[vertex];
    met.resize(records.size());
    std::vector<Solving> solving;
    for (std::size_t i = 0; i < records.size(); ++i) solving.push_back(start(s, vertex, records[i], met[i]));
    for (int sweep = 0; sweep < s.sweeps; ++sweep)
      for (std::size_t i = 0; i < records.size(); ++i) relax(s, solving[i], met[i]);
    s.step_losses[vertex] = {};
    for (std::size_t i = 0; i < records.size(); ++i) {
      s.faces[records[i].face].couple[records[i].corner] +=
          solving[i].jump.cross(Vec3(records[i].impulse + solving[i].secant));
      book(s, vertex, records[i]);
    }
  }
}

/// Books the given vertices anew, then closes the books of the step.
inline void settle(State& s, const std::vector<std::size_t>& changed_vertices) {
  for (const std::size_t vertex : changed_vertices) {
    s.step_losses[vertex] = {};
    for (const Record& record : s.records_of_vertex[vertex]) book(s, vertex, record);
  }
  for (std::size_t vertex = 0; vertex < s.records_of_vertex.size(); ++vertex)
    if (!s.records_of_vertex[vertex].empty()) s.losses[vertex] += s.step_losses[vertex];
}

}  // namespace knap::plain
