#include "analysis/equivalent_velocity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace knap {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

// Breakage on one curve over v_eq with this product, and a scatter like that of seeds.
std::vector<ObliqueImpact> made(double a_mu, double scatter, double friction = 0.3) {
  const BreakageCurve curve{0.6, 22.0, 5.0};
  std::vector<ObliqueImpact> impacts;
  int number = 0;
  for (const double angle : {30.0, 45.0, 60.0, 75.0, 90.0})
    for (double speed = 8.0; speed <= 30.0; speed += 2.0)
      for (int seed = 0; seed < 3; ++seed) {
        const double noise = scatter * std::sin(78.233 * ++number);
        const double v = equivalent_velocity(speed, angle * degree, a_mu);
        impacts.push_back({speed, angle * degree, friction, std::max(0.0, curve(v) + noise)});
      }
  return impacts;
}

TEST(EquivalentVelocity, HasItsLimits) {
  EXPECT_DOUBLE_EQ(equivalent_velocity(20.0, 90.0 * degree, 0.7), 20.0);
  EXPECT_DOUBLE_EQ(equivalent_velocity(20.0, 40.0 * degree, 0.0), 20.0 * std::sin(40.0 * degree));
  // As printed: v sqrt(sin^2 + a^2 mu^2 sin^2 cos^2), at 30 deg and a mu = 1.
  EXPECT_NEAR(equivalent_velocity(20.0, 30.0 * degree, 1.0), 20.0 * std::sqrt(0.25 + 0.25 * 0.75), 1e-12);
  // Rises with the angle up to a mu = 1, not beyond.
  const auto rises = [](double a_mu) {
    for (int i = 1; i < 90; ++i)
      if (equivalent_velocity(1.0, (i + 1) * degree, a_mu) < equivalent_velocity(1.0, i * degree, a_mu)) return false;
    return true;
  };
  EXPECT_TRUE(rises(1.0));
  EXPECT_FALSE(rises(1.5));
}

TEST(EquivalentVelocity, IsFoundInDataThatFollowIt) {
  const auto impacts = made(0.7, 0.02);
  const CollapseComparison result = compare_collapse(impacts, FrictionRule::FreeProduct, BreakageScale::Plain, 100);
  EXPECT_NEAR(result.model.value, 0.7, 0.04);
  EXPECT_TRUE(result.model.interval.contains(0.7));
  EXPECT_LT(result.model.interval.high - result.model.interval.low, 0.2);
  EXPECT_NEAR(result.model.curve.scale, 22.0, 0.5);
  EXPECT_LT(result.model.left_out_rms, 0.6 * result.null.left_out_rms);
  EXPECT_EQ(verdict(result), CollapseVerdict::Beats);
  EXPECT_EQ(result.model.left_out_by_angle.size(), 5U);
  EXPECT_NEAR(result.scatter, 0.02 * std::sqrt(0.5 * 2.0 / 3.0), 0.004);
}

TEST(EquivalentVelocity, IsFoundOnTheStabilisedScaleToo) {
  const CollapseComparison result =
      compare_collapse(made(0.7, 0.01), FrictionRule::FreeProduct, BreakageScale::Stabilised, 50);
  EXPECT_NEAR(result.model.value, 0.7, 0.08);
  EXPECT_EQ(verdict(result), CollapseVerdict::Beats);
}

TEST(EquivalentVelocity, KnownFrictionGivesTheFactor) {
  const CollapseComparison result =
      compare_collapse(made(0.6, 0.01), FrictionRule::KnownFriction, BreakageScale::Plain, 50);
  EXPECT_NEAR(result.model.value, 2.0, 0.1);  // 0.6/0.3
}

TEST(EquivalentVelocity, DoesNotBeatTheNullWhereOnlyTheNormalPartCounts) {
  const CollapseComparison result =
      compare_collapse(made(0.0, 0.03), FrictionRule::FreeProduct, BreakageScale::Plain, 100);
  EXPECT_LT(result.model.value, 0.2);
  EXPECT_LT(result.model.interval.low, 0.02);
  EXPECT_NE(verdict(result), CollapseVerdict::Beats);
}

TEST(EquivalentVelocity, StopsAtAMuOfOne) {
  std::vector<ObliqueImpact> impacts = made(1.0, 0.0);
  for (ObliqueImpact& impact : impacts)  // breaks even more under flat angles
    impact.breakage = BreakageCurve{0.6, 22.0, 5.0}(equivalent_velocity(impact.speed, impact.angle, 1.6));
  const CollapseComparison result = compare_collapse(impacts, FrictionRule::FreeProduct, BreakageScale::Plain, 20);
  EXPECT_TRUE(result.model.is_at_end);
  EXPECT_NEAR(result.model.value, 1.0, 1e-3);
}

TEST(EquivalentVelocity, LosesWhereThePartsAlongTheWallProtect) {
  auto impacts = made(0.0, 0.005);
  for (ObliqueImpact& impact : impacts)  // no a mu of 0 to 1 makes v_eq smaller than v sin th
    impact.breakage = std::max(0.0, impact.breakage - 0.1 * std::cos(impact.angle) * (impact.speed > 20.0 ? 1.0 : 0.0));
  const CollapseComparison result = compare_collapse(impacts, FrictionRule::FreeProduct, BreakageScale::Plain, 50);
  EXPECT_NE(verdict(result), CollapseVerdict::Beats);
  EXPECT_LT(result.model.value, 0.05);
  EXPECT_LE(result.scatter, result.null.left_out_rms);
}

TEST(EquivalentVelocity, HasNoVerdictWithoutRepeats) {
  std::vector<ObliqueImpact> impacts;
  for (const ObliqueImpact& impact : made(0.8, 0.01))
    if (impacts.empty() || impacts.back().speed != impact.speed || impacts.back().angle != impact.angle)
      impacts.push_back(impact);
  const CollapseComparison result = compare_collapse(impacts, FrictionRule::FreeProduct);
  EXPECT_FALSE(result.has_repeats);
  EXPECT_TRUE(std::isnan(result.gain.low));
  EXPECT_EQ(verdict(result), CollapseVerdict::Undecided);
  EXPECT_NEAR(result.model.value, 0.8, 0.1);
}

TEST(EquivalentVelocity, RefusesWhatCannotBeCompared) {
  auto impacts = made(0.5, 0.0);
  std::erase_if(impacts, [](const ObliqueImpact& impact) { return impact.angle < 70.0 * degree; });
  EXPECT_THROW(compare_collapse(impacts, FrictionRule::FreeProduct), std::invalid_argument);
  EXPECT_THROW(compare_collapse(made(0.5, 0.0, 0.0), FrictionRule::KnownFriction), std::invalid_argument);
}

}  // namespace
}  // namespace knap
