#include "analysis/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace knap {
namespace {

TEST(Statistics, MeanSpreadAndQuantiles) {
  const std::vector<double> values{4.0, 1.0, 3.0, 2.0};
  EXPECT_DOUBLE_EQ(mean(values), 2.5);
  EXPECT_DOUBLE_EQ(standard_deviation(values), std::sqrt(5.0 / 3.0));
  EXPECT_DOUBLE_EQ(quantile(values, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(quantile(values, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(quantile(values, 1.0), 4.0);
  EXPECT_TRUE(std::isnan(standard_deviation(std::vector<double>{1.0})));
  EXPECT_THROW(quantile({}, 0.5), std::invalid_argument);
}

TEST(Statistics, IntervalOfAMeanIsThatOfTheCentralLimit) {
  std::vector<double> values;
  for (int i = 0; i < 400; ++i) values.push_back(std::sin(1.0 + 12.9898 * i));  // spread of 1/sqrt 2
  const Interval interval = mean_interval(values);
  const double error = standard_deviation(values) / std::sqrt(400.0);
  EXPECT_NEAR(interval.low, mean(values) - 1.96 * error, 0.25 * error);
  EXPECT_NEAR(interval.high, mean(values) + 1.96 * error, 0.25 * error);
  EXPECT_EQ(mean_interval(values).low, interval.low);  // always the same draws
  EXPECT_TRUE(std::isnan(mean_interval(std::vector<double>{1.0}).low));
}

TEST(Statistics, DrawsKeepToTheirGroups) {
  const std::vector<std::vector<std::size_t>> groups{{0, 1, 2}, {3}, {4, 5}};
  const auto picks = bootstrap_picks(groups, 50);
  ASSERT_EQ(picks.size(), 50U);
  bool differ = false;
  for (const auto& pick : picks) {
    ASSERT_EQ(pick.size(), 6U);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_LT(pick[i], 3U);
    EXPECT_EQ(pick[3], 3U);
    for (std::size_t i = 4; i < 6; ++i) EXPECT_TRUE(pick[i] == 4 || pick[i] == 5);
    differ = differ || pick != picks[0];
  }
  EXPECT_TRUE(differ);
}

TEST(Statistics, WhatIsNotFiniteIsLeftOut) {
  const double nan = std::nan("");
  EXPECT_EQ(central_95({nan, 2.0, nan}).low, 2.0);
  EXPECT_TRUE(std::isnan(central_95({nan}).high));
}

}  // namespace
}  // namespace knap
