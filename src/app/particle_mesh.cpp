#include "app/particle_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "meshing/read_msh.hpp"
#include "meshing/reorder.hpp"

namespace knap {
namespace {

// Of a particle from a file: what counts as near the contact, over its height.
constexpr double near_over_height = 0.125;

struct Ends {
  Vec3 low, high;
};

Ends ends(const TetMesh& mesh) {
  const auto lower = [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); };
  return {*std::min_element(mesh.vertices.begin(), mesh.vertices.end(), lower),
          *std::max_element(mesh.vertices.begin(), mesh.vertices.end(), lower)};
}

// Mean edge of the tets whose centre is at a distance in [from, to] of the nearest of some points; 0 without any.
double local_mean_edge(const TetMesh& mesh, std::span<const Vec3> points, double from, double to) {
  double sum = 0.0;
  double count = 0.0;
  for (const auto& [a, b, c, d] : mesh.tets) {
    const std::array<Vec3, 4> x{mesh.vertices[at(a)], mesh.vertices[at(b)], mesh.vertices[at(c)], mesh.vertices[at(d)]};
    const Vec3 centre = 0.25 * (x[0] + x[1] + x[2] + x[3]);
    double distance = std::numeric_limits<double>::infinity();
    for (const Vec3& point : points) distance = std::min(distance, (centre - point).norm());
    if (distance < from || distance > to) continue;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < i; ++j) sum += (x[i] - x[j]).norm(), count += 1.0;
  }
  return count > 0.0 ? sum / count : 0.0;
}

TetMesh raw_mesh(const ParticleConfig& config) {
  if (const auto shape = particle_shape(config)) return tetrahedralise(*shape, mesh_options(config.mesh, *shape));
  const TetMesh mesh = read_msh(config.mesh_file, config.mesh_scale);
  check_mesh(mesh, config.mesh_file.string());
  return morton_ordered(mesh);
}

// A mesh with its sizes; what is nearer than `near` [m] to its lowest, or also its highest, point is at the contact.
ParticleMesh measured(TetMesh mesh, std::optional<double> near, bool contact_on_top) {
  ParticleMesh particle;
  particle.mesh = std::move(mesh);
  particle.quality = measure_quality(particle.mesh);
  particle.diameter = std::cbrt(6.0 / std::numbers::pi * particle.quality.total_volume);
  const auto [lowest, highest] = ends(particle.mesh);
  const double radius = near.value_or(near_over_height * (highest.z() - lowest.z()));
  std::vector<Vec3> contacts{lowest};
  if (contact_on_top) contacts.push_back(highest);
  const auto or_mean = [&](double edge) { return edge > 0.0 ? edge : particle.quality.mean_edge; };
  particle.contact_element_size = or_mean(local_mean_edge(particle.mesh, contacts, 0.0, radius));
  particle.element_size = or_mean(local_mean_edge(particle.mesh, contacts, 2.0 * radius, 1e300));
  return particle;
}

// What puts it just above the plane z = 0 [m].
Vec3 standing(const ParticleMesh& particle) {
  return (initial_gap(particle.contact_element_size) - ends(particle.mesh).low.z()) * Vec3::UnitZ();
}

void shift(TetMesh& mesh, const Vec3& way) {
  for (Vec3& x : mesh.vertices) x += way;
}

}  // namespace

std::optional<Shape> particle_shape(const ParticleConfig& particle) {
  switch (particle.shape) {
    case ParticleShape::Sphere:
      return Sphere{particle.diameter};
    case ParticleShape::Ellipsoid:
      return Ellipsoid{particle.diameters};
    case ParticleShape::Box:
      return Box{particle.lengths};
    case ParticleShape::MeshFile:
      break;
  }
  return std::nullopt;
}

TetrahedraliseOptions mesh_options(const MeshConfig& mesh, const Shape& shape) {
  const Vec3 lowest(0.0, 0.0, -0.5 * extent(shape).z());
  std::vector<Vec3> contacts{lowest};
  if (mesh.contact_on_top.value_or(false)) contacts.push_back(-lowest);
  return {.element_size = mesh.element_size,
          .contact_element_size = mesh.contact_element_size,
          .contact_extent = mesh.contact_extent,
          .contact_points = std::move(contacts),
          .seed = mesh.seed,
          .perturbation = mesh.perturbation};
}

double initial_gap(double contact_element_size) { return 1e-3 * contact_element_size; }

ParticleMesh make_particle_mesh(const ParticleConfig& config) {
  std::optional<double> near;
  if (config.shape != ParticleShape::MeshFile) near = config.mesh.contact_extent;
  ParticleMesh particle = measured(raw_mesh(config), near, config.mesh.contact_on_top.value_or(false));
  shift(particle.mesh, config.position.value_or(standing(particle)));  // shapes are meshed about the origin
  return particle;
}

ParticleMesh particle_on_plane(TetMesh mesh) {
  ParticleMesh particle = measured(std::move(mesh), std::nullopt, false);
  shift(particle.mesh, standing(particle));
  return particle;
}

}  // namespace knap
