// The law of a crack record over the lanes of a vector: what it can bear, what it spends; included once for every
// instruction set. The plain form is in linear_softening.hpp; its regimes at the top of vertex_impulses.cpp.
#if defined(KNAP_COHESIVE_IMPULSE_LAW_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef KNAP_COHESIVE_IMPULSE_LAW_INL_HPP
#undef KNAP_COHESIVE_IMPULSE_LAW_INL_HPP
#else
#define KNAP_COHESIVE_IMPULSE_LAW_INL_HPP
#endif

#include <hwy/highway.h>

#include "cohesive/vertex_kernel.hpp"
#include "core/vector3-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace knap {
namespace HWY_NAMESPACE {

HWY_INLINE V zero() { return hn::Zero(Tag()); }
HWY_INLINE V number(double value) { return hn::Set(Tag(), value); }

/// Coefficient of friction at damage `damage`.
HWY_INLINE V friction_of(const CohesiveLaw& law, V damage) {
  const V one = number(1.0), internal = number(law.internal_friction), sliding = number(law.sliding_friction);
  const V softening = law.softening_friction == SofteningFriction::KeepsConfinedStrength
                          ? internal
                          : hn::MulAdd(hn::Sub(one, damage), internal, hn::Mul(damage, sliding));
  return hn::IfThenElse(hn::Ge(damage, one), sliding, softening);
}

/// Cohesion and friction of records.
struct Resistance {
  V shear_capacity, friction;
};
HWY_INLINE Resistance resistance(const ImpulseCoefficients& k, M virgin, V strength, V d_max, V delta_c) {
  const V one = number(1.0);
  const V damage = hn::Min(one, hn::Div(d_max, delta_c));
  const V capacity = hn::Mul(hn::Mul(number(k.law.beta * k.dt), strength), hn::Sub(one, damage));
  return {hn::IfThenElseZero(virgin, capacity), friction_of(k.law, damage)};
}

/// The impulse nearest to `trial` that the records can bear: capacity in tension, Coulomb cone and cohesion in
/// compression. A push is smaller by what the gap still lets through: continuous in the gap, which round-off may open.
HWY_INLINE Vec3V admissible(const Vec3V& n, V beta, V inverse_beta, const Resistance& resistance, V closing_impulse,
                            const Vec3V& trial) {
  const V trial_n = dot(trial, n), shear_capacity = resistance.shear_capacity;
  const Vec3V tangential = difference(trial, scaled(trial_n, n));
  const V push = hn::Max(zero(), hn::Sub(trial_n, closing_impulse));
  const V normal_part = hn::IfThenElse(hn::Gt(trial_n, zero()), push, trial_n);
  const M tension = hn::Lt(normal_part, zero());
  const V capacity = hn::Mul(inverse_beta, shear_capacity);
  const V part = hn::IfThenElse(tension, hn::Max(normal_part, hn::Neg(capacity)), normal_part);
  // Exactly zero at full tension: what round-off would leave there has a large root.
  const V tension_limit2 = hn::Mul(hn::Mul(beta, beta), hn::Mul(hn::Sub(capacity, part), hn::Add(capacity, part)));
  const V limit = hn::MulAdd(resistance.friction, part, shear_capacity);
  const V limit2 = hn::IfThenElse(tension, tension_limit2, hn::Mul(limit, limit));
  const V size2 = dot(tangential, tangential);
  const V scale = hn::IfThenElse(hn::Gt(size2, limit2), hn::Sqrt(hn::Div(limit2, size2)), number(1.0));
  return scaled_sum(part, n, scaled(scale, tangential));
}

/// A jump of records, split along the normals of their faces.
struct Opening {
  V normal, opening;  // jn, <jn>
  Vec3V tangential;
  V tangential2;
};
HWY_INLINE Opening opening_of(const Vec3V& jump, const Vec3V& n) {
  const V jn = dot(jump, n);
  const Vec3V tangential = difference(jump, scaled(jn, n));
  return {jn, hn::Max(jn, zero()), tangential, dot(tangential, tangential)};
}

/// What impulses and damage spend, lane by lane.
struct Spent {
  V cohesive, cohesive_shear;  // damage, for good
  V separation, closure, friction;
};
HWY_INLINE Spent nothing_spent() { return {zero(), zero(), zero(), zero(), zero()}; }

/// What the booking of records needs.
struct Booked {
  Vec3V normal, impulse;
  V shear_capacity, friction;
  M virgin;
};

// Work taken from the bodies by impulses at a mean slip velocity.
HWY_INLINE void book_impulses(const Booked& b, const Vec3V& slip, Spent& spent) {
  const V pn = dot(b.impulse, b.normal);
  const V normal_loss = hn::Neg(hn::Mul(pn, dot(slip, b.normal)));
  const V tangential_loss = hn::Sub(hn::Neg(dot(b.impulse, slip)), normal_loss);
  const V frictional = hn::Mul(hn::Max(zero(), pn), b.friction);
  const V share =
      hn::IfThenElseZero(hn::Gt(frictional, zero()), hn::Div(frictional, hn::Add(frictional, b.shear_capacity)));
  const V friction = hn::IfThenElse(b.virgin, hn::Mul(share, tangential_loss), tangential_loss);
  const M separates = hn::AndNot(hn::Gt(pn, zero()), b.virgin);
  spent.friction = hn::Add(spent.friction, friction);
  spent.separation = hn::Add(spent.separation, hn::Sub(tangential_loss, friction));
  spent.separation = hn::Add(spent.separation, hn::IfThenElseZero(separates, normal_loss));
  spent.closure = hn::Add(spent.closure, hn::IfThenZeroElse(separates, normal_loss));
}

}  // namespace HWY_NAMESPACE
}  // namespace knap
HWY_AFTER_NAMESPACE();
#endif
