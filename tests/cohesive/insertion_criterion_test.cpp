#include "cohesive/insertion_criterion.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace knap {
namespace {

// The largest effective traction over many directions of the normal, for a stress along the axes.
double largest_effective(const CohesiveLaw& law, double xx, double yy, double zz) {
  const TetStress stress{.xx = xx, .yy = yy, .zz = zz};
  double largest = -1e300;
  for (int i = 0; i <= 900; ++i)
    for (int j = 0; j < 36; ++j) {
      const double polar = std::numbers::pi / 2 * i / 900, around = std::numbers::pi / 2 * j / 35;
      const Vec3 n(std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around), std::cos(polar));
      largest = std::max(largest, effective_traction(law, traction(stress, n), n));
    }
  return largest;
}

TEST(InsertionCriterion, HydrostaticCompressionBreaksNothing) {
  const double p = 1e9;
  EXPECT_LT(largest_effective({}, -p, -p, -p), 0.0);
}

TEST(InsertionCriterion, UniaxialTensionBreaksAtTheStrength) {
  EXPECT_NEAR(largest_effective({}, 0, 0, 8e6), 8e6, 8e6 * 1e-6);
}

// Mohr-Coulomb with cohesion beta sigma_c: unconfined strength 2 beta (mu_i + sqrt(1 + mu_i^2)) sigma_c.
TEST(InsertionCriterion, UniaxialCompressionBreaksAtTheMohrCoulombRatio) {
  for (const double beta : {1.0, 1.5, 2.0})
    for (const double friction : {0.0, 0.4, 0.8}) {
      const CohesiveLaw law{.beta = beta, .internal_friction = friction};
      const double ratio = 2.0 * beta * (friction + std::sqrt(1.0 + friction * friction));
      // The sweep of normals in steps of 0.1 degrees misses the maximum by less than 1e-5.
      EXPECT_NEAR(largest_effective(law, 0, 0, -ratio), 1.0, 1e-5) << beta << " " << friction;
    }
}

TEST(InsertionCriterion, ContinuousWhereTensionTurnsToCompression) {
  const CohesiveLaw law;
  const Vec3 n = Vec3::UnitZ();
  EXPECT_NEAR(effective_traction(law, {1.0, 0.0, 1e-9}, n), effective_traction(law, {1.0, 0.0, -1e-9}, n), 1e-8);
}

}  // namespace
}  // namespace knap
