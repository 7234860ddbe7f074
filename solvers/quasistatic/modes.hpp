#pragma once
#include "fem/stiffness.hpp"

namespace knap {

/// A free vibration.
struct Mode {
  double frequency = 0.0;   ///< [Hz]
  std::vector<Vec3> shape;  ///< by node, the largest displacement 1 [-]
};

struct ModesOptions {
  int count = 20;            ///< how many
  double tolerance = 1e-10;  ///< relative, of the squared frequencies [-]
};

/// The body whose vibrations are looked for; masses by node [kg].
struct VibratingBody {
  const Topology& topology;
  std::span<const Vec3> reference_positions;  ///< [m]
  const Material& material;                   ///< its long-term elasticity counts
  std::span<const double> masses;             ///< lumped [kg]
};

/// The lowest free vibrations of a body that nothing holds, ascending, without the six rigid motions. None is left out,
/// not even of several with the same frequency. Throws InputError when the mesh has not that many, RuntimeFailure when
/// the iteration does not converge.
std::vector<Mode> free_modes(const VibratingBody& body, const ModesOptions& options = {});

/// For each mode, in how many modes one of its kind comes: the size of its cluster of frequencies, each within
/// `relative_gap` of the next.
std::vector<int> multiplicities(std::span<const Mode> modes, double relative_gap = 5e-3);

}  // namespace knap
