#pragma once

namespace knap {

/// An elastic sphere that hits a rigid wall at right angles.
struct HertzImpact {
  double reduced_modulus = 0.0;  ///< E* = E / (1 - nu^2) [Pa]
  double density = 0.0;          ///< [kg/m3]
  double diameter = 0.0;         ///< [m]
  double speed = 0.0;            ///< normal [m/s]
};

// Hertz's quasi-static theory of impact (Johnson 1985, Contact Mechanics, section 11.4), for a sphere of mass
// m = pi rho d^3 / 6 and R = d/2.

/// Largest approach [m], (15 m v^2 / (16 E* sqrt R))^(2/5).
double largest_approach(const HertzImpact& impact);
/// Peak force [N], 4/3 E* sqrt(R) delta^(3/2) = 0.7574 E*^0.4 (rho v^2)^0.6 d^2.
double peak_force(const HertzImpact& impact);
/// Largest contact radius [m], R (5 pi rho v^2 / (4 E*))^(1/5).
double contact_radius(const HertzImpact& impact);
/// Duration of the contact [s], 2.9433 delta / v; 0 at rest.
double contact_time(const HertzImpact& impact);

/// The normal speed [m/s] at which the tensile stress 0.9 F / d^2 (Hiramatsu & Oka 1966) of the peak force F reaches
/// `strength` [Pa]; impact.speed and impact.diameter play no part.
double critical_speed(const HertzImpact& impact, double strength);

}  // namespace knap
