#pragma once
// What the cracks of a state come to, as pure functions: shared by history, frames, progress and the report.
#include "cohesive/fragments.hpp"
#include "simulation/simulation.hpp"

namespace knap {

/// Areas of all cracks so far [m2].
struct CrackCensus {
  double area = 0.0;          ///< of all facets that have opened
  double area_mode_i = 0.0;   ///< the part of it in proportion to the work of separation spent by opening
  double area_mode_ii = 0.0;  ///< and by shear
  double failed_area = 0.0;   ///< of the corners that carry no load any more
};
CrackCensus crack_census(const Simulation& s);

/// Number of pieces, labels taken from the state as it is now.
Index count_fragments(const Simulation& s, FragmentLabel label);

/// Mean damage [0, 1] of the three corners by facet: 0 when bonded, 1 when failed or handed over.
std::vector<double> facet_damage(const Simulation& s);
/// Largest damage of a tet's facets, by tet.
std::vector<double> tet_damage(const Simulation& s);

/// How the whole particle moves, relative to the start.
struct Rebound {
  double normal = 0.0;      ///< velocity of the mass centre along the wall's normal over the incident normal speed [-]
  double tangential = 0.0;  ///< along the incident tangential direction over that speed; nan at normal impact [-]
};
Rebound rebound(const Simulation& s);

/// What momentum balance misses.
struct MomentumErrors {
  double linear = 0.0;   ///< |P - P0 - wall - added mass| / (m v)
  double angular = 0.0;  ///< |L - L0 - wall - added mass - pending couple| / max(m v R, |L0|)
};
/// `radius` [m] of the particle. Lost momentum by mass scaling is accounted for.
MomentumErrors momentum_errors(const Simulation& s, double radius);

}  // namespace knap
