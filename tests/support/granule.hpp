#pragma once
#include "meshing/tetrahedralise.hpp"
#include "simulation/make_simulation.hpp"

namespace knap {

/// A zeolite sphere just above the wall z = 0 (physics.md section 2), for tests to vary.
struct Granule {
  double diameter = 1.5e-3;
  double element_size = 0.15e-3;
  double contact_element_size = 0.15e-3;
  double contact_extent = 0.3e-3;
  ParticleOptions particle{.young_modulus = 2.45e9, .poisson_ratio = 0.25, .density = 1270.0};
  SimulationOptions options{};  ///< all but the particle
};

inline FractureOptions zeolite_fracture() {
  FractureOptions fracture;
  fracture.strength = 8.34e6;
  fracture.fracture_energy = 8.6;
  return fracture;
}

inline TetMesh granule_mesh(const Granule& granule) {
  const double radius = 0.5 * granule.diameter;
  TetrahedraliseOptions options;
  options.element_size = granule.element_size;
  options.contact_element_size = granule.contact_element_size;
  options.contact_points = {{0.0, 0.0, -radius}};
  options.contact_extent = granule.contact_extent;
  TetMesh mesh = tetrahedralise(Sphere{granule.diameter}, options);
  double lowest = 0.0;
  for (const Vec3& x : mesh.vertices) lowest = std::min(lowest, x.z());
  for (Vec3& x : mesh.vertices) x.z() += 1e-9 - lowest;
  return mesh;
}

inline Simulation make_granule(const Granule& granule) {
  SimulationOptions options = granule.options;
  options.particles = {granule.particle};
  return make_simulation(options, granule_mesh(granule));
}

}  // namespace knap
