#pragma once
// A bar along x that answers in one dimension: no Poisson's ratio, a single cell across, held
// across, and cracks only straight across.
#include "simulation/make_simulation.hpp"

namespace knap {

struct BarOptions {
  double young_modulus = 1.0;    ///< [Pa]
  double density = 1.0;          ///< [kg/m3]
  double strength = 1.0;         ///< [Pa]
  double fracture_energy = 1.0;  ///< [J/m2]
  Index cells = 1;
  double cell = 1.0;  ///< edge [m]
  double step_safety = 0.5;
  bool ends_are_led = false;  ///< that at x = 0 is held, the other moves
  double end_speed = 0.0;     ///< of the other end along x [m/s]

  double length() const { return cell * cells; }
  double wave_speed() const { return std::sqrt(young_modulus / density); }
  /// l_ch = E G_c / sigma_c^2 [m].
  double characteristic_length() const { return young_modulus * fracture_energy / (strength * strength); }
};

/// The bar at rest. Facets that are not between two cells never break.
Simulation make_bar(const BarOptions& options);

/// Number of the plane between two cells that a facet lies in, 1 to cells - 1; none for a facet across no plane.
Index plane_of_facet(const Simulation& s, const BarOptions& options, Index facet);

/// Gives the unbroken bar a strain and a velocity along x as functions of x in the unstrained bar, and begins its
/// balances. The velocity is that half a step before.
template <class Displacement, class Velocity>
void set_bar_in_motion(Simulation& s, const Displacement& displacement, const Velocity& velocity) {
  for (Index i = 0; i < s.nodes.size(); ++i) {
    const double x = s.reference.vertices[at(i)].x();
    s.nodes.x[at(i)].x() = x + displacement(x);
    s.nodes.v[at(i)].x() = s.nodes.v_before[at(i)].x() = velocity(x);
  }
  update_elastic_forces(s.elastic, s.nodes.x, s.nodes.f, 0.0);
  balance_from_here(s);
}

/// The planes that have failed with all their facets, ascending.
std::vector<Index> failed_planes(const Simulation& s, const BarOptions& options);

}  // namespace knap
