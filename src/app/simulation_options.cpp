#include "app/simulation_options.hpp"

#include <cmath>

namespace knap {
namespace {

Vec3 impact_velocity(const ImpactConfig& impact) {
  // Exactly normal at 90 deg, whose cosine is not exactly 0 in floating point.
  const double along = std::abs(std::cos(impact.angle)) < 1e-15 ? 0.0 : std::cos(impact.angle);
  return impact.speed *
         Vec3(along * std::cos(impact.azimuth), along * std::sin(impact.azimuth), -std::sin(impact.angle));
}

FractureOptions fracture_options(const FractureConfig& fracture) {
  return {.law = {.beta = fracture.shear_strength_ratio,
                  .kappa = fracture.mode_ii_ratio,
                  .internal_friction = fracture.internal_friction,
                  .sliding_friction = fracture.sliding_friction,
                  .softening_friction = fracture.crack_friction == CrackFriction::Blended
                                            ? SofteningFriction::Blended
                                            : SofteningFriction::KeepsConfinedStrength},
          .strength = fracture.strength,
          .fracture_energy = fracture.fracture_energy,
          .weibull_modulus = fracture.weibull_modulus,
          .weibull_reference_volume = fracture.weibull_reference_volume,
          .weibull_seed = static_cast<std::uint64_t>(fracture.weibull_seed)};
}

}  // namespace

SimulationOptions simulation_options(const RunConfig& config) {
  SimulationOptions options{.young_modulus = config.particles[0].material.young_modulus,
                            .poisson_ratio = config.particles[0].material.poisson_ratio,
                            .density = config.particles[0].material.density,
                            .viscous_ratio = config.particles[0].material.viscous_ratio,
                            .relaxation_time = config.particles[0].material.relaxation_time,
                            .fracture = std::nullopt,
                            .tools = {wall(config.impact.wall_friction)},
                            .velocity = impact_velocity(config.impact),
                            .spin = config.impact.spin,
                            .step_safety = config.run.step_safety,
                            .insertion_interval = config.run.insertion_interval};
  if (config.particles[0].fracture.insertion != Insertion::None)
    options.fracture = fracture_options(config.particles[0].fracture);
  return options;
}

}  // namespace knap
