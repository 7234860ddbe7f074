#pragma once
// Isotropic linear elasticity: conversions between its constants.
#include <cmath>

namespace knap {

/// Lame's constants [Pa].
struct Lame {
  double lambda = 0.0;
  double mu = 0.0;  ///< shear modulus
};

/// From Young's modulus [Pa] and Poisson's ratio [-], which must lie in (-1, 0.5).
inline Lame lame(double young_modulus, double poisson_ratio) {
  return {young_modulus * poisson_ratio / ((1.0 + poisson_ratio) * (1.0 - 2.0 * poisson_ratio)),
          young_modulus / (2.0 * (1.0 + poisson_ratio))};
}

inline double young_modulus(const Lame& l) { return l.mu * (3.0 * l.lambda + 2.0 * l.mu) / (l.lambda + l.mu); }
inline double poisson_ratio(const Lame& l) { return l.lambda / (2.0 * (l.lambda + l.mu)); }
inline double bulk_modulus(const Lame& l) { return l.lambda + 2.0 / 3.0 * l.mu; }
/// Modulus of uniaxial strain M = lambda + 2 mu [Pa].
inline double p_wave_modulus(const Lame& l) { return l.lambda + 2.0 * l.mu; }

/// Speed of longitudinal waves c_p [m/s]; density in [kg/m3].
inline double p_wave_speed(const Lame& l, double density) { return std::sqrt(p_wave_modulus(l) / density); }
/// Speed of shear waves c_s [m/s]; density in [kg/m3].
inline double s_wave_speed(const Lame& l, double density) { return std::sqrt(l.mu / density); }

}  // namespace knap
