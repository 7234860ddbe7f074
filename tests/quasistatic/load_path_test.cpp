#include "quasistatic/load_path.hpp"

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "tests/quasistatic/press.hpp"
#include "tests/support/bar_mesh.hpp"

namespace knap {
namespace {

// In uniform uniaxial compression -s a facet whose normal has the angle a with the axis bears t_n = -s cos^2 a and
// t_t = s sin a cos a: (t_t + mu_i t_n)/beta is its share of the strength.
TEST(LoadPath, ABlockYieldsWhereMohrAndCoulombSay) {
  const PressedBody block{bar_mesh({3, 3, 6}, 1e-4)};
  const CohesiveLaw law{.beta = 1.5, .internal_friction = 0.3};
  const double sigma = 5e6;
  const std::vector<double> strength(at(block.topology.num_facets()), sigma);
  double largest = 0.0;  // over the facets of Kuhn's cells
  for (const Vec3& n : {Vec3(1, 0, 1), Vec3(0, 1, -1), Vec3(1, 0, 0), Vec3(1, -1, 0), Vec3(0, 0, 1)}) {
    const double c = n.normalized().z();
    largest = std::max(largest, (std::abs(c) * std::sqrt(1.0 - c * c) - law.internal_friction * c * c) / law.beta);
  }
  const Onset onset = load_to_onset(block.view(), block.platens(), {law, strength});
  const double stress = sigma / largest;
  EXPECT_NEAR(onset.force / 9e-8, stress, 0.03 * stress);  // finite strain of 1 %
  EXPECT_GE(onset.facet.effective, sigma);
  EXPECT_LE(onset.facet.effective, 1.002 * sigma);
  EXPECT_LT(onset.steps[onset.steps.size() - 2].utilisation, 1.0);
  EXPECT_NEAR(onset.strain_energy, 0.5 * onset.force * onset.approach, 0.02 * onset.strain_energy);
}

TEST(LoadPath, ATurnedPressDoesTheSame) {
  PressedBody sphere{.mesh = coarse_sphere(), .friction = 0.3};
  const CohesiveLaw law;
  const std::vector<double> strength(at(sphere.topology.num_facets()), 8.34e6);
  auto platens = sphere.platens();
  platens[1].share = 1.0;
  platens[0].share = 0.0;
  platens[1].point.z() += 3e-6;  // a gap first
  const Onset upright = load_to_onset(sphere.view(), platens, {law, strength});
  EXPECT_NEAR(upright.path[1].z(), -3e-6 - upright.approach, 1e-15);
  EXPECT_EQ(upright.path[0], Vec3::Zero());

  const Mat3 turn = Eigen::AngleAxisd(2.0, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  for (Vec3& v : sphere.mesh.vertices) v = turn * v;
  for (Platen& platen : platens) platen.point = turn * platen.point, platen.normal = turn * platen.normal;
  const Onset turned = load_to_onset(sphere.view(), platens, {law, strength});
  EXPECT_NEAR(turned.force, upright.force, 1e-3 * upright.force);  // both are bracketed to that
  EXPECT_EQ(turned.facet.facet, upright.facet.facet);
  EXPECT_LT((turned.path[1] - turn * upright.path[1]).norm(), 2e-3 * upright.path[1].norm());
}

TEST(LoadPath, WhatCannotBeLoadedIsRefused) {
  const PressedBody block{bar_mesh({2, 2, 2}, 1e-4)};
  const CohesiveLaw law;
  const std::vector<double> strong(at(block.topology.num_facets()), 1e12);
  EXPECT_THROW(load_to_onset(block.view(), block.platens(), {law, strong}), InputError);
  auto platens = block.platens();
  platens[1].normal = Vec3(0.1, 0.0, -1.0).normalized();
  EXPECT_THROW(load_to_onset(block.view(), platens, {law, strong}), InputError);
}

}  // namespace
}  // namespace knap
