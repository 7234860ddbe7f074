#pragma once
#include <optional>

#include "cohesive/linear_softening.hpp"
#include "loading/tool_options.hpp"

namespace knap {

/// How facets break; absent = they never do.
struct FractureOptions {
  CohesiveLaw law{};
  double strength = 0.0;                  ///< sigma_c [Pa]
  double fracture_energy = 0.0;           ///< mode I [J/m2]
  double weibull_modulus = 0.0;           ///< 0 = uniform strength
  double weibull_reference_volume = 0.0;  ///< [m3]
  std::uint64_t weibull_seed = 1;
};

/// Everything a simulation is made from, beside the mesh; SI.
struct SimulationOptions {
  double young_modulus = 0.0;
  double poisson_ratio = 0.0;
  double density = 0.0;
  double viscous_ratio = 0.0;    ///< of the viscoelastic branch [-]
  double relaxation_time = 0.0;  ///< of that branch [s]
  std::optional<FractureOptions> fracture{};
  std::vector<ToolOptions> tools{};
  Vec3 velocity = Vec3::Zero();  ///< of the whole particle at the start [m/s]
  Vec3 spin = Vec3::Zero();      ///< about its mass centre [rad/s]
  double step_safety = 0.5;      ///< time step over the nodal stability bound
  int insertion_interval = 4;    ///< steps between two checks of the insertion criterion
  int label_interval = 48;       ///< steps between two looks for new fragments
  int ledger_interval = 24;      ///< steps between two energy balances
  int impulse_sweeps = 2;        ///< Gauss-Seidel sweeps of the vertex impulses
  int contact_sweeps = 4;        ///< Gauss-Seidel sweeps of the general contact
};

}  // namespace knap
