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
          .weibull_seed = static_cast<std::uint64_t>(fracture.weibull_seed),
          .penalty_ratio = fracture.insertion == Insertion::Intrinsic ? fracture.penalty_ratio : 0.0};
}

ParticleOptions particle_options(const ParticleConfig& particle, const ImpactConfig& impact) {
  ParticleOptions options{.young_modulus = particle.material.young_modulus,
                          .poisson_ratio = particle.material.poisson_ratio,
                          .density = particle.material.density,
                          .viscous_ratio = particle.material.viscous_ratio,
                          .relaxation_time = particle.material.relaxation_time,
                          .fracture = std::nullopt,
                          .friction = particle.fracture.sliding_friction,
                          .velocity = particle.velocity.value_or(impact_velocity(impact)),
                          .spin = particle.spin.value_or(impact.spin)};
  if (particle.fracture.insertion != Insertion::None) options.fracture = fracture_options(particle.fracture);
  return options;
}

}  // namespace

Vec3 start_velocity(const RunConfig& config, const ParticleConfig& particle) {
  return particle.velocity.value_or(impact_velocity(config.impact));
}

SimulationOptions simulation_options(const RunConfig& config) {
  SimulationOptions options{.particles = {},
                            .gravity = config.run.gravity,
                            .step_safety = config.run.step_safety,
                            .insertion_interval = config.run.insertion_interval};
  for (const ParticleConfig& particle : config.particles)
    options.particles.push_back(particle_options(particle, config.impact));
  const ContactConfig& contact = config.contact;
  options.rigid_fragments.enabled = contact.rigid_fragments;
  if (contact.rigid_fragments) {
    options.rigid_fragments.quiet_crossings = contact.freeze_after_crossings;
    options.rigid_fragments.approach_share = contact.wake_at_speed_share;
    options.rigid_fragments.load_share = contact.wake_at_load_share;
    options.restitution = contact.restitution;
  }
  return options;
}

}  // namespace knap
