#include "cohesive/linear_softening.hpp"

#include <gtest/gtest.h>

namespace knap {
namespace {

constexpr double s0 = 8.34e6, fracture_energy = 8.6, delta_c = 2.0 * fracture_energy / s0;

// Traction of a softening record along (jn, jt), after d_max.
Vec3 law_traction(const CohesiveLaw& law, double jn, double jt, double d_max) {
  const double stiffness = secant_stiffness(s0, d_max, delta_c);
  return {stiffness * law.beta * law.beta / law.kappa * jt, 0.0, stiffness * std::max(jn, 0.0)};
}

// Work [J/m2] of opening along a straight path in mode mixity `angle` until failure, by the midpoint rule.
double work_of_separation(const CohesiveLaw& law, double angle) {
  const double cn = std::cos(angle), ct = std::sin(angle) * law.kappa / law.beta;
  const int steps = 200000;
  double work = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double d = delta_c * (i + 0.5) / steps;
    work += law_traction(law, d * cn, d * ct, d).dot(Vec3(ct, 0.0, cn)) * delta_c / steps;
  }
  return work;
}

TEST(LinearSoftening, WorkOfSeparationIsTheFractureEnergy) {
  for (const double beta : {1.0, 1.5, 2.5}) {
    const CohesiveLaw law{.beta = beta};
    for (const double angle : {0.0, 0.4, 0.8, 1.2, 1.5707963267948966})  // mode I, mixed, mode II
      EXPECT_NEAR(work_of_separation(law, angle) / fracture_energy, 1.0, 1e-6) << beta << " " << angle;
  }
}

TEST(LinearSoftening, ModeTwoCostsKappaTimesModeOne) {
  const CohesiveLaw law{.beta = 1.5, .kappa = 3.0};
  EXPECT_NEAR(work_of_separation(law, 0.0) / fracture_energy, 1.0, 1e-6);
  EXPECT_NEAR(work_of_separation(law, 1.5707963267948966) / fracture_energy, 3.0, 3e-6);
}

TEST(LinearSoftening, ReloadingBelowTheLargestOpeningCostsNothing) {
  const CohesiveLaw law;
  const double d_max = 0.4 * delta_c;
  double work = 0.0;
  const int steps = 1000;
  for (int i = 0; i < 2 * steps; ++i) {  // to d_max and back
    const double from = d_max * (i < steps ? i : 2 * steps - i) / steps;
    const double to = d_max * (i < steps ? i + 1 : 2 * steps - i - 1) / steps;
    work += law_traction(law, 0.5 * (from + to), 0.0, d_max).z() * (to - from);
  }
  EXPECT_NEAR(work / fracture_energy, 0.0, 1e-12);
}

TEST(LinearSoftening, TractionIsTheGradientOfTheStoredEnergy) {
  const CohesiveLaw law{.beta = 1.7, .kappa = 1.4};
  const double d_max = 0.3 * delta_c, jn = 0.1 * delta_c, jt = 0.07 * delta_c, h = 1e-6 * delta_c;
  const auto stored = [&](double n, double t) {
    return 0.5 * secant_stiffness(s0, d_max, delta_c) * energy_opening2(law, n, t * t);
  };
  const Vec3 traction = law_traction(law, jn, jt, d_max);
  EXPECT_NEAR((stored(jn + h, jt) - stored(jn - h, jt)) / (2 * h) / traction.z(), 1.0, 1e-8);
  EXPECT_NEAR((stored(jn, jt + h) - stored(jn, jt - h)) / (2 * h) / traction.x(), 1.0, 1e-8);
}

TEST(LinearSoftening, FrictionGoesFromInternalToSliding) {
  CohesiveLaw law;
  EXPECT_EQ(crack_friction(law, 0.99), law.internal_friction);
  EXPECT_EQ(crack_friction(law, 1.0), law.sliding_friction);
  law.softening_friction = SofteningFriction::Blended;
  EXPECT_NEAR(crack_friction(law, 0.5), 0.5 * (law.internal_friction + law.sliding_friction), 1e-15);
}

}  // namespace
}  // namespace knap
