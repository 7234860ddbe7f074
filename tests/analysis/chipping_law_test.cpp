#include "analysis/chipping_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace knap {
namespace {

TEST(ChippingLaw, ExponentIsFoundWithAnInterval) {
  std::vector<Chipping> runs;
  int number = 0;
  for (const double speed : {15.0, 17.0, 19.0, 22.0, 25.0})
    for (int seed = 0; seed < 5; ++seed)
      runs.push_back({speed, 1e-5 * std::pow(speed, 2.44) * (1.0 + 0.1 * std::sin(12.9898 * ++number))});
  const ChippingLaw law = fit_chipping_law(runs);
  EXPECT_NEAR(law.exponent, 2.44, 0.2);
  EXPECT_TRUE(law.interval.contains(2.44));
  EXPECT_LT(law.interval.high - law.interval.low, 1.0);
  EXPECT_EQ(law.num_speeds, 5U);
  EXPECT_EQ(law.slowest, 15.0);
  EXPECT_EQ(law.fastest, 25.0);
}

TEST(ChippingLaw, IsExactWithoutScatterAndLeavesOutWhatLosesNothing) {
  std::vector<Chipping> runs{{5.0, 0.0}, {5.0, 0.0}};
  for (const double speed : {10.0, 20.0, 40.0}) runs.push_back({speed, 1e-6 * std::pow(speed, 3.17)});
  const ChippingLaw law = fit_chipping_law(runs);
  EXPECT_NEAR(law.exponent, 3.17, 1e-12);
  EXPECT_NEAR(law.factor, 1e-6, 1e-15);
  EXPECT_EQ(law.slowest, 10.0);
  runs.pop_back();
  EXPECT_THROW(fit_chipping_law(runs), std::invalid_argument);
}

}  // namespace
}  // namespace knap
