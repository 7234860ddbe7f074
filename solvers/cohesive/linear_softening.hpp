#pragma once
// An initially rigid law: no opening before the strength is reached, then linear softening in the effective opening
//   d = sqrt(<j_n>^2 + (beta/kappa)^2 |j_t|^2),   T = K(d_max) (<j_n> n + beta^2/kappa j_t),   K = s0 (1/d_max -
//   1/delta_c)
// with unloading to the origin (Camacho & Ortiz 1996; kappa = G_IIc/G_Ic after Snozzi & Molinari 2013, eq. 8-10).
#include <algorithm>
#include <cmath>

#include "core/types.hpp"

namespace knap {

/// Friction between the faces of a crack that still softens.
enum class SofteningFriction {
  KeepsConfinedStrength,  ///< internal friction until full failure, then sliding friction
  Blended                 ///< (1 - D) internal + D sliding friction
};

/// The numbers of the cohesive law shared by all facets.
struct CohesiveLaw {
  double beta = 1.5;               ///< shear strength over tensile strength [-]
  double kappa = 1.0;              ///< mode II over mode I fracture energy [-]
  double internal_friction = 0.8;  ///< of the criterion and until failure [-]
  double sliding_friction = 0.1;   ///< of failed facets [-]
  SofteningFriction softening_friction = SofteningFriction::KeepsConfinedStrength;
};

/// Squared effective opening [m2] of a jump with normal part jn and squared tangential part jt2.
inline double effective_opening2(const CohesiveLaw& law, double jn, double jt2) {
  const double opening = std::max(jn, 0.0);
  const double shear = law.beta / law.kappa;
  return opening * opening + shear * shear * jt2;
}

/// Secant stiffness [Pa/m] of the softening branch; d_max in (0, delta_c].
inline double secant_stiffness(double s0, double d_max, double delta_c) {
  return std::max(0.0, s0 * (1.0 / d_max - 1.0 / delta_c));
}

/// Squared opening conjugate to the secant stiffness: stored energy per area = K/2 times this [m2].
inline double energy_opening2(const CohesiveLaw& law, double jn, double jt2) {
  const double opening = std::max(jn, 0.0);
  return opening * opening + law.beta * law.beta / law.kappa * jt2;
}

/// Friction coefficient of a crack face with damage D in [0, 1].
inline double crack_friction(const CohesiveLaw& law, double damage) {
  if (damage >= 1.0) return law.sliding_friction;
  if (law.softening_friction == SofteningFriction::KeepsConfinedStrength) return law.internal_friction;
  return (1.0 - damage) * law.internal_friction + damage * law.sliding_friction;
}

}  // namespace knap
