#include "config/derived_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

namespace knap {
namespace {

constexpr double default_num_tets = 20000.0;
constexpr double most_tets = 2e7;  // as the mesher allows

// Tets in a volume h^3 at a mean edge h, measured on this project's meshes (regular tets, which do not fill space,
// would be 6 sqrt 2 = 8.5).
constexpr double edge_cubed_per_volume = 10.9;

double rounded_to_3_digits(double x) {
  const std::string text = fmt::format("{:.2e}", x);
  double rounded = x;
  std::from_chars(text.data(), text.data() + text.size(), rounded);
  return rounded;
}

double cubed(double x) { return x * x * x; }

// Tets of the coarse particle plus those of the half ball that is refined.
double estimated_num_tets(const RunConfig& config) {
  const double volume = particle_volume(config.particle);
  const double refined = std::min(volume, 2.0 / 3.0 * std::numbers::pi * cubed(config.mesh.contact_extent));
  return edge_cubed_per_volume *
         (volume / cubed(config.mesh.element_size) + refined / cubed(config.mesh.contact_element_size));
}

}  // namespace

double particle_volume(const ParticleConfig& particle) {
  switch (particle.shape) {
    case ParticleShape::Sphere:
      return std::numbers::pi / 6.0 * cubed(particle.diameter);
    case ParticleShape::Ellipsoid:
      return std::numbers::pi / 6.0 * particle.diameters.prod();
    case ParticleShape::Box:
      return particle.lengths.prod();
    case ParticleShape::MeshFile:
      break;
  }
  return 0.0;
}

double smallest_extent(const ParticleConfig& particle) {
  switch (particle.shape) {
    case ParticleShape::Sphere:
      return particle.diameter;
    case ParticleShape::Ellipsoid:
      return particle.diameters.minCoeff();
    case ParticleShape::Box:
      return particle.lengths.minCoeff();
    case ParticleShape::MeshFile:
      break;
  }
  return 0.0;
}

void add_derived_values(RunConfig& config) {
  MeshConfig& mesh = config.mesh;
  for (std::int64_t* seed : {&mesh.seed, &config.fracture.weibull_seed})
    if (*seed == not_given) *seed = config.run.seed;
  if (config.particle.shape != ParticleShape::MeshFile) {
    if (mesh.element_size == 0.0) {
      const double edge = std::cbrt(edge_cubed_per_volume * particle_volume(config.particle) / default_num_tets);
      const double largest = 0.5 * smallest_extent(config.particle);
      mesh.element_size = std::max(mesh.contact_element_size, std::min(largest, rounded_to_3_digits(edge)));
    }
    if (mesh.contact_element_size == 0.0) mesh.contact_element_size = mesh.element_size;
    if (mesh.contact_extent == 0.0) mesh.contact_extent = 0.25 * smallest_extent(config.particle);
  }
  const MaterialConfig& material = config.material;
  FractureConfig& fracture = config.fracture;
  if (fracture.toughness > 0.0) {
    const double nu = material.poisson_ratio;
    fracture.fracture_energy = fracture.toughness * fracture.toughness * (1.0 - nu * nu) / material.young_modulus;
  }
}

std::vector<std::string> contradictions(const RunConfig& config) {
  std::vector<std::string> found;
  const MeshConfig& mesh = config.mesh;
  if (config.particle.shape != ParticleShape::MeshFile) {
    const double extent = smallest_extent(config.particle);
    if (mesh.element_size > 0.5 * extent)
      found.push_back(
          fmt::format("mesh.element_size = {} m: must be at most half the smallest extent of the particle, {} m",
                      mesh.element_size, extent));
    if (mesh.contact_element_size > mesh.element_size)
      found.push_back(fmt::format("mesh.contact_element_size = {} m: must be at most mesh.element_size, {} m",
                                  mesh.contact_element_size, mesh.element_size));
    if (const double tets = estimated_num_tets(config); !(tets <= most_tets))
      found.push_back(
          fmt::format("mesh.element_size = {} m, contact_element_size = {} m: about {:.1e} tets, allowed are "
                      "{:.0e}; larger elements or a smaller contact_extent are needed",
                      mesh.element_size, mesh.contact_element_size, tets, most_tets));
  }
  if (const double modulus = config.fracture.weibull_modulus; modulus > 0.0 && modulus < 1.0)
    found.push_back(
        fmt::format("fracture.weibull_modulus = {}: must be 0 (uniform strength) or from 1 to 1000", modulus));
  const double energy = config.fracture.fracture_energy;
  if (energy != 0.0 && !(energy >= 1e-12 && energy <= 1e9))
    found.push_back(
        fmt::format("fracture.toughness = {} Pa m^1/2: gives a fracture energy of {:.3g} J/m2, allowed are "
                    "1e-12 to 1e9 J/m2",
                    config.fracture.toughness, energy));
  return found;
}

}  // namespace knap
