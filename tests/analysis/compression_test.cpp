#include "analysis/compression.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace knap {
namespace {

// A force that rises linearly to a peak, falls to a part of it and rises again, under a vibration without impulse.
struct Pressing {
  double peak_time = 4.0, fall = 0.3, vibration = 0.0, period = 0.1;

  double impulse(double t) const {
    const double shake =
        vibration * period / (2.0 * std::numbers::pi) * (1.0 - std::cos(2.0 * std::numbers::pi * t / period));
    if (t <= peak_time) return 0.5 * t * t + shake;
    const double later = t - peak_time;
    return 0.5 * peak_time * peak_time + fall * peak_time * later + 0.5 * later * later + shake;
  }
  ForceCurve curve(double end) const {
    ForceCurve curve;
    for (double t = 0.0; t < end; t += 0.01) {
      curve.time.push_back(t);
      curve.displacement.push_back(2.0 * t);
      curve.impulse.push_back(impulse(t));
    }
    return curve;
  }
};

TEST(FractureForce, IsThePeakBeforeTheDropNotTheLargestForce) {
  const ForceCurve curve = Pressing{}.curve(20.0);
  const auto force = smoothed_force(curve, 0.02);
  EXPECT_GT(force.back(), 10.0);
  const FractureForce found = fracture_force(curve, force, 0.5, 3.0);
  EXPECT_TRUE(found.has_dropped);
  EXPECT_NEAR(found.force, 4.0, 0.02);
  EXPECT_NEAR(found.displacement, 8.0, 0.05);
  EXPECT_NEAR(found.strength, 0.9 * 4.0 / 9.0, 0.002);
}

TEST(FractureForce, AVibrationIsSmoothedAway) {
  const ForceCurve curve = Pressing{.vibration = 2.0}.curve(8.0);
  const FractureForce found = fracture_force(curve, smoothed_force(curve, 0.2), 0.5, 1.0);
  EXPECT_TRUE(found.has_dropped);
  EXPECT_NEAR(found.force, 3.9, 0.05);  // the mean over two periods ends half of them before its time
}

TEST(FractureForce, WithoutADropItIsTheLargestSoFar) {
  const ForceCurve curve = Pressing{}.curve(3.0);
  const FractureForce found = fracture_force(curve, smoothed_force(curve, 0.02), 0.5, 1.0);
  EXPECT_FALSE(found.has_dropped);
  EXPECT_NEAR(found.force, 3.0, 0.03);
}

TEST(FractureForce, ASmallBounceAtTheStartIsNoFracture) {
  const ForceCurve curve{{0, 1, 2, 3, 4, 5, 6}, {0, 1, 2, 3, 4, 5, 6}, {0, 0.1, 0.1, 2, 5, 9, 9.1}};
  const FractureForce found = fracture_force(curve, smoothed_force(curve, 1.0), 0.5, 1.0);
  EXPECT_TRUE(found.has_dropped);
  EXPECT_DOUBLE_EQ(found.force, 4.0);
  EXPECT_DOUBLE_EQ(found.time, 5.0);
}

TEST(FractureForce, NoForceIsNoFracture) {
  const ForceCurve curve{{0, 1, 2}, {0, 1, 2}, {0, 0, 0}};
  EXPECT_EQ(fracture_force(curve, smoothed_force(curve, 1.0), 0.5, 1.0).force, 0.0);
  EXPECT_EQ(fracture_force({}, {}, 0.5, 1.0).force, 0.0);
}

}  // namespace
}  // namespace knap
