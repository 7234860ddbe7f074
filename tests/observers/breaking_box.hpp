#pragma once
#include <gtest/gtest.h>

#include "simulation/make_simulation.hpp"
#include "simulation/step.hpp"
#include "tests/support/bar_mesh.hpp"
#include "tests/support/temporary_folder.hpp"

namespace knap {

/// A box of 384 tets that breaks on the wall after some hundred steps.
inline Simulation breaking_box(double viscous_ratio = 0.0) {
  TetMesh mesh = bar_mesh({4, 4, 4}, 0.25e-3);
  for (Vec3& x : mesh.vertices) x = Vec3(x.x(), x.y(), x.z() + 1e-7);
  ParticleOptions particle{.young_modulus = 2.45e9, .poisson_ratio = 0.25, .density = 1270.0};
  particle.fracture = FractureOptions{.law = {}, .strength = 8.34e6, .fracture_energy = 8.6};
  particle.velocity = Vec3(5.0, 0.0, -30.0);
  particle.viscous_ratio = viscous_ratio;
  particle.relaxation_time = 2e-6;
  SimulationOptions options{.particles = {particle}};
  options.tools = {wall(0.3)};
  return make_simulation(options, mesh);
}

inline void advance(Simulation& s, int steps) {
  for (int i = 0; i < steps; ++i) ASSERT_EQ(step(s), StepStatus::Ok);
}

using ObserverTest = TemporaryFolder;

}  // namespace knap
