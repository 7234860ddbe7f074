#pragma once
// One cracked facet whose two faces are moved apart along a given path: what the solver of crack impulses does, without
// anything else. The nodes are so heavy that the impulses do not move them.
#include "simulation/simulation.hpp"

namespace knap {

struct DrivenCrackOptions {
  CohesiveLaw law{};
  double strength = 1.0;         ///< [Pa]
  double fracture_energy = 0.5;  ///< [J/m2]

  double delta_c() const { return 2.0 * fracture_energy / strength; }
};

/// Jump of the plus face against the minus face, and the traction that pulls them together.
struct CrackPoint {
  double opening = 0.0, slip = 0.0;    ///< [m]
  double normal = 0.0, tangent = 0.0;  ///< [Pa]
};

struct CrackPath {
  std::vector<CrackPoint> points;
  double dissipated = 0.0;  ///< as the ledger books it, per area [J/m2]
  double stored = 0.0;      ///< per area, at the end [J/m2]
  double work = 0.0;        ///< of the traction along the path, trapezoidal rule [J/m2]
};

/// Moves the faces through the points (opening, slip), one a step, from the closed crack.
CrackPath drive_crack(const DrivenCrackOptions& options, std::span<const std::array<double, 2>> path);

/// A path through corner points, `steps` steps from each to the next, beginning at (0, 0). The first of them begin
/// small: a crack is still rigid in the first step, whatever its length.
std::vector<std::array<double, 2>> straight_path(std::span<const std::array<double, 2>> corners, int steps);

}  // namespace knap
