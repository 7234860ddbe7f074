#pragma once
// A Maxwell branch beside the elastic law (together a standard linear solid), in Green strain E = (F^T F - I)/2, hence
// frame-indifferent and free of inverses:
//   S_b = C_b : (E - E_v),   dE_v/dt = (E - E_v)/tau,   C_b = ratio x isotropic C(lambda, mu),   P_b = F S_b
// Time levels (Strang): half a step of exact relaxation at fixed E, the stress, half a step again; E_v lives at half
// steps, as the velocities do. Its loss is the energy dropped by the two halves, never negative; with leapfrog it
// closes the energy balance to O(dt^2), where relaxing after the stress would leave O(dt).
#include <cmath>

#include "core/types.hpp"
#include "materials/lame.hpp"

namespace knap {

struct ViscoelasticBranch {
  double ratio = 0.0;            ///< stiffness over the long-term one [-]; 0 = no branch
  double relaxation_time = 0.0;  ///< tau [s]

  bool is_active() const { return ratio > 0.0; }
  /// By which factor the branch's elastic strain falls in half a step of dt [s] at fixed strain.
  double half_step_decay(double dt) const { return is_active() ? std::exp(-0.5 * dt / relaxation_time) : 1.0; }
};

/// State of the branch at one point.
struct ViscoelasticHistory {
  Mat3 viscous_strain = Mat3::Zero();  ///< E_v [-], at half steps
};

inline Mat3 green_strain(const Mat3& F) { return 0.5 * (F.transpose() * F - Mat3::Identity()); }

/// Second Piola-Kirchhoff stress [Pa] of the branch at the elastic strain E - E_v.
inline Mat3 branch_stress(const ViscoelasticBranch& branch, const Lame& l, const Mat3& elastic_strain) {
  return branch.ratio * (l.lambda * elastic_strain.trace() * Mat3::Identity() + 2.0 * l.mu * elastic_strain);
}

/// Energy stored in the branch per reference volume [J/m3] at the elastic strain E - E_v.
inline double branch_energy_density(const ViscoelasticBranch& branch, const Lame& l, const Mat3& elastic_strain) {
  return 0.5 * branch_stress(branch, l, elastic_strain).cwiseProduct(elastic_strain).sum();
}

/// What one step of the branch gives at a point, all at the whole step.
struct BranchResponse {
  Mat3 stress = Mat3::Zero();      ///< S_b [Pa]
  double stored = 0.0;             ///< [J/m3]
  double dissipated_before = 0.0;  ///< in the half step before [J/m3], >= 0
  double dissipated_after = 0.0;   ///< in the half step after [J/m3], >= 0
};

/// Relaxes over half a step dt/2 [s] at strain E, takes stress and energy, relaxes over the other half.
inline BranchResponse advance(const ViscoelasticBranch& branch, const Lame& l, const Mat3& E, double dt,
                              ViscoelasticHistory& history) {
  const double q = branch.half_step_decay(dt);
  const Mat3 before = E - history.viscous_strain;
  const Mat3 now = q * before;
  history.viscous_strain += (1.0 - q * q) * before;
  const double stored = branch_energy_density(branch, l, now);
  return {branch_stress(branch, l, now), stored, (1.0 / (q * q) - 1.0) * stored, (1.0 - q * q) * stored};
}

}  // namespace knap
