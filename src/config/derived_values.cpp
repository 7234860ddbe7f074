#include "config/derived_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "config/flat_tools.hpp"

namespace knap {
namespace {

constexpr double default_num_tets = 20000.0;

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

constexpr double thickness_over_radius = 0.25;
constexpr std::int64_t seeds_between_particles = 1000;

void add_mesh_sizes(ParticleConfig& particle, bool loaded_from_both_ends) {
  if (particle.shape == ParticleShape::MeshFile) return;
  MeshConfig& mesh = particle.mesh;
  if (mesh.element_size == 0.0) {
    const double edge = std::cbrt(edge_cubed_per_volume * particle_volume(particle) / default_num_tets);
    const double largest = 0.5 * smallest_extent(particle);
    mesh.element_size = std::max(mesh.contact_element_size, std::min(largest, rounded_to_3_digits(edge)));
  }
  if (mesh.contact_element_size == 0.0) mesh.contact_element_size = mesh.element_size;
  if (mesh.contact_extent == 0.0) mesh.contact_extent = 0.25 * smallest_extent(particle);
  if (!mesh.contact_on_top) mesh.contact_on_top = loaded_from_both_ends;
}

void add_fracture_energy(ParticleConfig& particle) {
  FractureConfig& fracture = particle.fracture;
  if (fracture.toughness <= 0.0) return;
  const double nu = particle.material.poisson_ratio;
  fracture.fracture_energy =
      fracture.toughness * fracture.toughness * (1.0 - nu * nu) / particle.material.young_modulus;
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

double estimated_num_tets(const ParticleConfig& particle) {
  const MeshConfig& mesh = particle.mesh;
  const double volume = particle_volume(particle);
  const double contacts = mesh.contact_on_top.value_or(false) ? 2.0 : 1.0;
  const double refined = std::min(volume, contacts * 2.0 / 3.0 * std::numbers::pi * cubed(mesh.contact_extent));
  return edge_cubed_per_volume * (volume / cubed(mesh.element_size) + refined / cubed(mesh.contact_element_size));
}

void add_derived_values(RunConfig& config) {
  std::int64_t seed = config.run.seed;
  for (std::size_t i = 0; i < config.particles.size(); ++i, seed += seeds_between_particles) {
    ParticleConfig& particle = config.particles[i];
    if (particle.name.empty()) particle.name = fmt::format("particle{}", i + 1);
    for (std::int64_t* own : {&particle.mesh.seed, &particle.fracture.weibull_seed})
      if (*own == not_given) *own = seed;
    add_mesh_sizes(particle, flat_tools_press_along_z(config));
    add_fracture_energy(particle);
  }
  for (std::size_t i = 0; i < config.tools.size(); ++i) {
    ToolConfig& tool = config.tools[i];
    if (tool.name.empty()) tool.name = fmt::format("tool{}", i + 1);
    if (tool.type == ToolKind::Platen && tool.thickness == 0.0) tool.thickness = thickness_over_radius * tool.radius;
  }
}

}  // namespace knap
