#pragma once
#include <array>
#include <span>

#include "simulation/simulation.hpp"

namespace knap {

/// A facet that is cracked before a run begins. Its faces meet: what is left of it is the damage.
struct InitialCrack {
  Index facet = none;
  double strength = 0.0;           ///< effective traction at insertion s0 [Pa]
  std::array<double, 3> damage{};  ///< of its corners: largest opening so far over that at full failure [-], 1 = failed
};

/// Cracks the facets of a simulation that has just been made, ascending, and begins its balances. Nothing is spent:
/// what cohesion has dissipated in the run is what it dissipates from here on; RunTotals::inserted_facets counts them.
void open_initial_cracks(Simulation& s, std::span<const InitialCrack> cracks);

}  // namespace knap
