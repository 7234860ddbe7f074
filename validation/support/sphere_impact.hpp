#pragma once
// A sphere that strikes a rigid wall, and what Hertz says of it.
#include "tests/support/granule.hpp"

namespace knap {

/// Hertz's impact on a rigid wall; lengths in m, forces in N, times in s.
struct HertzOutcome {
  double approach = 0.0;  ///< largest
  double force = 0.0;     ///< largest
  double duration = 0.0;
};

/// From mass [kg], speed [m/s], E/(1 - nu^2) [Pa] and radius [m].
HertzOutcome hertz_impact(double mass, double speed, double reduced_modulus, double radius);
/// Its force over the largest, from the first touch on, at times over the duration.
std::vector<double> hertz_force(const std::vector<double>& times);

/// Of 1 mm radius, zeolite but for Poisson's ratio; the mesh is graded to the contact.
struct SphereImpact {
  double group = 1e-6;            ///< rho v^2/E*, v along the normal [-]
  double poisson_ratio = 0.25;    ///< [-]
  double elements = 5.0;          ///< of the contact radius by Hertz; all sizes go with it
  double friction = 0.0;          ///< with the wall [-]
  double tangential_speed = 0.0;  ///< along x over the normal one [-]
  double step_safety = 0.8;       ///< [-]

  double radius() const { return 1e-3; }
  double reduced_modulus() const;  ///< E* [Pa]
  double speed() const;            ///< v [m/s]
  double contact_radius() const;   ///< [m]
};

/// On the wall z = 0.
Simulation make_impact(const SphereImpact& impact);

/// The mean force in each of many windows.
struct ForceHistory {
  std::vector<double> time{}, force{};  ///< middle of the window since the first touch [s], normal force [N]
  double duration = 0.0;                ///< from the first to the last touch [s]
  double restitution = 0.0;             ///< of the normal velocity of the mass centre [-]
};

/// Steps until `end` [s] with windows of `window` [s].
ForceHistory follow_force(Simulation& s, double end, double window);

}  // namespace knap
