#include "app/particle_overlap.hpp"

#include <gtest/gtest.h>

#include "tests/support/bar_mesh.hpp"

namespace knap {
namespace {

// A cube of 1 m whose lowest corner is at `corner`, turned by `angle` about z through its centre.
TetMesh cube(const Vec3& corner, double angle = 0.0) {
  TetMesh mesh = bar_mesh({3, 3, 3}, 1.0 / 3.0);
  const Vec3 centre(0.5, 0.5, 0.5);
  const Eigen::AngleAxisd turn(angle, Vec3::UnitZ());
  for (Vec3& x : mesh.vertices) x = corner + centre + turn * Vec3(x - centre);
  return mesh;
}

TEST(ParticleOverlap, IsFoundHoweverSmall) {
  EXPECT_TRUE(overlap(cube({0, 0, 0}), cube({0, 0, 0})));
  EXPECT_TRUE(overlap(cube({0, 0, 0}), cube({0.999, 0.9, 0.8})));
  EXPECT_TRUE(overlap(cube({0, 0, 0}), cube({0.1, 0.1, -0.9999})));
}

TEST(ParticleOverlap, NeighboursDoNotOverlap) {
  EXPECT_FALSE(overlap(cube({0, 0, 0}), cube({1.0001, 0, 0})));
  EXPECT_FALSE(overlap(cube({0, 0, 0}), cube({5, 5, 5})));
}

// Turned by 45 degrees the cubes' boxes overlap long before they do: edges meet at a distance of sqrt 2.
TEST(ParticleOverlap, BoxesAreNotBodies) {
  const double quarter = EIGEN_PI / 4.0;
  const double diagonal = 1.0 / std::sqrt(2.0);
  EXPECT_FALSE(overlap(cube({0, 0, 0}, quarter), cube({1.001 * diagonal, 1.001 * diagonal, 0.3}, quarter)));
  EXPECT_TRUE(overlap(cube({0, 0, 0}, quarter), cube({0.999 * diagonal, 0.999 * diagonal, 0.3}, quarter)));
}

}  // namespace
}  // namespace knap
