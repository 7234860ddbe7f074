#pragma once
// Compressible neo-Hookean solid without logarithm or inverse, so it stays finite, and pulls back, when a tet inverts:
//   W = mu/2 (F:F - 3) - mu (J - 1) + (lambda + mu)/2 (J - 1)^2
// (Smith, de Goes & Kim 2018, "Stable neo-Hookean flesh simulation", ACM Trans. Graph. 37(2), without their logarithmic
// term). It linearises to Hooke's law with the same lambda and mu, and is exact under rotation.
#include <algorithm>

#include "core/types.hpp"
#include "materials/lame.hpp"

namespace knap {

struct NeoHookean {
  double lambda = 0.0;  ///< [Pa]
  double mu = 0.0;      ///< [Pa]

  Lame small_strain() const { return {lambda, mu}; }
  /// dU/dJ [Pa] of the volumetric part of W, which makes P = mu F + dU/dJ cof F. T: double or a vector of them.
  double volumetric_slope(double J) const { return (lambda + mu) * (J - 1.0) - mu; }
  /// d2U/dJ2 [Pa].
  double volumetric_curvature(double) const { return lambda + mu; }
};

/// The shear part of the Cauchy stress divides by max(|J|, this): bounded where an element collapses, and an inverted
/// one is in compression across the inverted direction, so it never looks like tension to a fracture criterion.
inline constexpr double smallest_volume_ratio = 0.1;

/// Cofactor matrix, J F^-T, without dividing by J.
inline Mat3 cofactor(const Mat3& F) {
  Mat3 C;
  C << F.col(1).cross(F.col(2)), F.col(2).cross(F.col(0)), F.col(0).cross(F.col(1));
  return C;
}

/// Strain energy per reference volume [J/m3].
inline double energy_density(const NeoHookean& law, const Mat3& F) {
  const double j = F.determinant() - 1.0;
  return 0.5 * law.mu * (F.squaredNorm() - 3.0) - law.mu * j + 0.5 * (law.lambda + law.mu) * j * j;
}

/// First Piola-Kirchhoff stress dW/dF [Pa].
inline Mat3 first_piola(const NeoHookean& law, const Mat3& F) {
  return law.mu * F + law.volumetric_slope(F.determinant()) * cofactor(F);
}

/// Cauchy stress P F^T / J [Pa], guarded as smallest_volume_ratio says.
inline Mat3 cauchy_stress(const NeoHookean& law, const Mat3& F) {
  const double J = F.determinant();
  return law.mu / std::max(std::abs(J), smallest_volume_ratio) * F * F.transpose() +
         law.volumetric_slope(J) * Mat3::Identity();
}

}  // namespace knap
