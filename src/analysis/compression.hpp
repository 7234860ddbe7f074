#pragma once
// The strength of a particle that is pressed until it breaks.
#include <vector>

namespace knap {

/// The force of a tool on the particle over the way of the tool.
struct ForceCurve {
  std::vector<double> time;          ///< ascending [s]
  std::vector<double> displacement;  ///< of the tool along its motion [m]
  std::vector<double> impulse;       ///< against its motion, since the start [N s]
};

/// Mean force over the `window` before each time [s]; at the start over what there is. Waves that run to and fro in the
/// particle make the force of an instant meaningless.
std::vector<double> smoothed_force(const ForceCurve& curve, double window);

struct FractureForce {
  double force = 0.0;         ///< largest before the drop [N]
  double displacement = 0.0;  ///< of the tool there [m]
  double time = 0.0;          ///< [s]
  double strength = 0.0;      ///< sigma = 0.9 F/d^2 [Pa], below
  bool has_dropped = false;   ///< else it is the largest force so far
};

/// The first maximum of a smoothed force that a fall to `share` of it follows; small maxima, below a tenth of the
/// curve's largest, are the particle finding its place. sigma = 0.9 F/d^2 for a sphere of diameter d [m] (Hiramatsu &
/// Oka 1966). All zeros for a curve without force.
FractureForce fracture_force(const ForceCurve& curve, const std::vector<double>& force, double share, double diameter);

}  // namespace knap
