#pragma once
#include <algorithm>
#include <optional>
#include <vector>

#include "cohesive/linear_softening.hpp"
#include "loading/prescribed_nodes.hpp"
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
  double penalty_ratio =
      0.0;  ///< alpha of intrinsic bonds, springs of alpha M/h; 0 = facets are rigid until they crack
};

/// One particle: its solid, how it breaks, how it starts; SI.
struct ParticleOptions {
  double young_modulus = 0.0;
  double poisson_ratio = 0.0;
  double density = 0.0;
  double viscous_ratio = 0.0;    ///< of the viscoelastic branch [-]
  double relaxation_time = 0.0;  ///< of that branch [s]
  std::optional<FractureOptions> fracture{};
  double friction = 0.1;         ///< Coulomb, on other particles: the smaller of both holds [-]
  Vec3 velocity = Vec3::Zero();  ///< of the whole particle at the start [m/s]
  Vec3 spin = Vec3::Zero();      ///< about its mass centre [rad/s]
};

/// When fragments are carried as rigid bodies, and when they become deformable again. Shares of energy are of the
/// strength energy sigma^2/(2E) per volume of the fragment, sigma the strength of its weakest facet that may still
/// break; a fragment without one is asked neither for them nor for quiet, and never wakes.
struct RigidFragmentOptions {
  bool enabled = false;
  bool whole = false;            ///< also what has come off nothing: a whole particle, a piece that the mesh came with
  double quiet_crossings = 5.0;  ///< without insertion or noticeable damage, in times that a wave takes to cross it
  int quiet_steps = 192;         ///< likewise, in steps: the longer of both
  double noticeable_damage = 0.1;  ///< growth of a facet's mean damage that ends the quiet [-]
  double strain_share = 0.5;       ///< largest strain energy of a fragment that freezes [-]
  double vibration_share = 1.0;    ///< largest kinetic energy beside its rigid motion [-]
  double loss_share = 0.01;      ///< all vibrations that freezing may take, over the reference energy of the ledger [-]
  double approach_share = 0.25;  ///< of the critical impact speed: a faster approach wakes a body [-]
  double load_share = 0.3;       ///< of the weakest facet's strength: a larger 0.9 F/d^2 wakes a body [-]
};

/// Everything a simulation is made from, beside the meshes; SI.
struct SimulationOptions {
  std::vector<ParticleOptions> particles = std::vector<ParticleOptions>(1);  ///< one for each mesh
  std::vector<ToolOptions> tools{};
  std::vector<PrescribedOptions> prescribed{};
  Vec3 gravity = Vec3::Zero();  ///< [m/s2]
  double step_safety = 0.5;     ///< time step over the nodal stability bound
  int insertion_interval = 4;   ///< steps between two checks of the insertion criterion
  int label_interval = 48;      ///< steps between two looks for new fragments
  int ledger_interval = 24;     ///< steps between two energy balances
  int impulse_sweeps = 2;       ///< Gauss-Seidel sweeps of the vertex impulses
  int contact_interval = 8;     ///< steps between two looks for what overlaps
  int contact_sweeps = 2;       ///< Gauss-Seidel sweeps of the general contact, at least
  RigidFragmentOptions rigid_fragments{};
  double restitution = 0.0;  ///< between rigid fragments: speed of parting over speed of approach [-]
};

/// Whether any particle can break.
inline bool can_break(const SimulationOptions& options) {
  return std::any_of(options.particles.begin(), options.particles.end(),
                     [](const ParticleOptions& particle) { return particle.fracture.has_value(); });
}

}  // namespace knap
