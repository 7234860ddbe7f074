#include "core/random.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace knap {
namespace {

TEST(SplitMix, GivesTheNumbersOfTheReferenceImplementation) {
  std::uint64_t state = 1234567;  // reference: Vigna, splitmix64.c, prng.di.unimi.it
  EXPECT_EQ(splitmix64(state), 6457827717110365317ULL);
  EXPECT_EQ(splitmix64(state), 3203168211198807973ULL);
  EXPECT_EQ(splitmix64(state), 9817491932198370423ULL);
}

TEST(SplitMix, RotationsAreRotations) {
  std::uint64_t state = 1;
  for (int i = 0; i < 100; ++i) {
    const Mat3 r = random_rotation(state);
    EXPECT_NEAR((r * r.transpose() - Mat3::Identity()).norm(), 0.0, 1e-14);
    EXPECT_NEAR(r.determinant(), 1.0, 1e-14);
  }
}

// A quarter of the points lie in the inner quarter of the volume, an eighth in each octant.
TEST(SplitMix, PointsInABallFillIt) {
  std::uint64_t state = 2;
  constexpr int count = 10000;
  int inner = 0, octant = 0;
  for (int i = 0; i < count; ++i) {
    const Vec3 x = random_in_unit_ball(state);
    ASSERT_LE(x.norm(), 1.0);
    inner += x.norm() < std::cbrt(0.25) ? 1 : 0;
    octant += x.minCoeff() > 0.0 ? 1 : 0;
  }
  EXPECT_NEAR(inner, count / 4, 5.0 * std::sqrt(count * 3.0 / 16.0));  // five deviations
  EXPECT_NEAR(octant, count / 8, 5.0 * std::sqrt(count * 7.0 / 64.0));
}

}  // namespace
}  // namespace knap
