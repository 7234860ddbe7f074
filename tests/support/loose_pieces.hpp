#pragma once
#include <random>

#include "simulation/make_simulation.hpp"
#include "tests/fem/grid_mesh.hpp"

namespace knap {

/// Adds a cube of n^3 cells of edge `length` [m], centred at `centre` and turned, as a piece of its own.
inline void add_cube(TetMesh& mesh, Index n, double length, const Vec3& centre,
                     const Eigen::Quaterniond& orientation = Eigen::Quaterniond::Identity()) {
  const TetMesh cube = grid_mesh(n, length, 0.0);
  const Index first = mesh.num_vertices();
  for (const Vec3& x : cube.vertices)
    mesh.vertices.push_back(centre + orientation * (x - Vec3::Constant(0.5 * length)));
  for (const TetCorners& tet : cube.tets)
    mesh.tets.push_back({first + tet[0], first + tet[1], first + tet[2], first + tet[3]});
}

/// Pieces of a solid that does not break; rigid from the first step on if `rigid`.
inline SimulationOptions loose_options(bool rigid, double friction) {
  ParticleOptions particle{.young_modulus = 2.45e9, .poisson_ratio = 0.25, .density = 1270.0};
  FractureOptions fracture;
  fracture.strength = 1e15;
  fracture.fracture_energy = 1e3;
  fracture.law.sliding_friction = friction;
  particle.fracture = fracture;
  particle.friction = friction;
  SimulationOptions options{.particles = {particle}};
  if (rigid)
    options.rigid_fragments = {.enabled = true,
                               .whole = true,
                               .quiet_crossings = 0.0,
                               .quiet_steps = 0,
                               .strain_share = 1e300,
                               .vibration_share = 1e300,
                               .loss_share = 1e300};
  return options;
}

}  // namespace knap
