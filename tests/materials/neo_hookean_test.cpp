#include "materials/neo_hookean.hpp"

#include <gtest/gtest.h>

#include "materials/material.hpp"

namespace knap {
namespace {

const NeoHookean law{1.3, 0.7};

Mat3 some_gradient(int i) {
  std::srand(static_cast<unsigned>(i));
  return Mat3::Identity() + 0.4 * Mat3::Random();
}

TEST(NeoHookean, StressIsTheGradientOfTheEnergy) {
  const double h = 1e-6;
  for (int i = 0; i < 20; ++i) {
    const Mat3 F = some_gradient(i);
    const Mat3 P = first_piola(law, F);
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) {
        Mat3 up = F, down = F;
        up(r, c) += h;
        down(r, c) -= h;
        // Central difference: O(h^2) of third derivatives plus rounding 1e-16/h.
        EXPECT_NEAR((energy_density(law, up) - energy_density(law, down)) / (2 * h), P(r, c), 1e-8);
      }
  }
}

TEST(NeoHookean, LinearisesToHooke) {
  const Mat3 H = 1e-6 * Mat3{{1.0, 0.3, -0.2}, {0.5, -0.7, 0.1}, {0.0, 0.4, 0.6}};
  const Mat3 strain = 0.5 * (H + H.transpose());
  const Mat3 hooke = law.lambda * strain.trace() * Mat3::Identity() + 2 * law.mu * strain;
  EXPECT_LT((first_piola(law, Mat3::Identity() + H) - hooke).norm(), 1e-5 * hooke.norm());
}

TEST(NeoHookean, RotationsAreFree) {
  const Mat3 R = Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  EXPECT_NEAR(energy_density(law, R), 0.0, 1e-15);
  EXPECT_LT(first_piola(law, R).norm(), 1e-14);
  const Mat3 F = some_gradient(3);
  EXPECT_LT((first_piola(law, R * F) - R * first_piola(law, F)).norm(), 1e-14);
  EXPECT_LT((cauchy_stress(law, R * F) - R * cauchy_stress(law, F) * R.transpose()).norm(), 1e-13);
}

TEST(NeoHookean, CauchyStressIsPiolaPushedForward) {
  const Mat3 F = some_gradient(5);
  EXPECT_LT((cauchy_stress(law, F) - first_piola(law, F) * F.transpose() / F.determinant()).norm(), 1e-13);
}

TEST(NeoHookean, CollapseAndInversionStayFiniteAndPushBack) {
  for (const double stretch : {1.0, 0.5, 0.1, 1e-3, 0.0, -1e-3, -0.5, -1.0}) {
    const Mat3 F = Vec3(1.0, 1.0, stretch).asDiagonal();
    EXPECT_TRUE(cauchy_stress(law, F).allFinite());
    EXPECT_LT(cauchy_stress(law, F).norm(), 100.0);
    if (stretch < 1.0) {
      EXPECT_LT(first_piola(law, F)(2, 2), 0.0) << stretch;  // drives the stretch up again
    }
  }
}

TEST(Lame, ConvertsBothWays) {
  const Lame l = lame(15e9, 0.2);
  EXPECT_NEAR(young_modulus(l), 15e9, 1e-3);
  EXPECT_NEAR(poisson_ratio(l), 0.2, 1e-15);
  EXPECT_NEAR(bulk_modulus(l), 15e9 / (3 * (1 - 0.4)), 1e-3);
  EXPECT_NEAR(p_wave_speed(l, 2000.0), std::sqrt(15e9 * 0.8 / (1.2 * 0.6) / 2000.0), 1e-9);
  EXPECT_NEAR(s_wave_speed(l, 2000.0), std::sqrt(15e9 / 2.4 / 2000.0), 1e-9);
  EXPECT_DOUBLE_EQ(make_material(15e9, 0.2, 2000.0).small_strain().mu, l.mu);
}

}  // namespace
}  // namespace knap
