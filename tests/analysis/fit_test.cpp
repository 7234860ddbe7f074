#include "analysis/fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace knap {
namespace {

TEST(Fit, OfAStraightLineIsThatOfLinearRegression) {
  const std::vector<double> x{0.0, 1.0, 2.0, 3.0, 4.0}, y{1.1, 2.9, 5.2, 6.8, 9.1};
  const Law line = [&](std::span<const double> p, std::size_t i) { return p[0] + p[1] * x[i]; };
  const Fit fit = least_squares_fit({{"offset", "m", -10.0, 10.0}, {"slope", "-", -10.0, 10.0}}, line, y);
  // By hand: means 2 and 5.02, Sxx 10, Sxy 19.9; squares of the residuals 0.107, over 3 degrees of freedom.
  EXPECT_NEAR(fit.value("slope"), 1.99, 1e-6);
  EXPECT_NEAR(fit.value("offset"), 1.04, 1e-6);
  EXPECT_NEAR(fit.loss, 0.107, 1e-9);
  const double s2 = 0.107 / 3.0;
  EXPECT_NEAR(fit.error("slope"), std::sqrt(s2 / 10.0), 1e-6);
  EXPECT_NEAR(fit.error("offset"), std::sqrt(s2 * (1.0 / 5.0 + 4.0 / 10.0)), 1e-6);
  EXPECT_NEAR(fit.covariance(0, 1), -s2 * 2.0 / 10.0, 1e-6);
  EXPECT_NEAR(rms_residual(line, fit.values, y), std::sqrt(0.107 / 5.0), 1e-9);
  EXPECT_FALSE(fit.is_at_end[0] || fit.is_at_end[1]);
}

TEST(Fit, OfAProbabilityIsTheShareWithItsBinomialError) {
  std::vector<bool> outcomes(40, false);
  for (int i = 0; i < 12; ++i) outcomes[3 * i] = true;
  const Fit fit = probability_fit(
      {{"p", "-", 0.001, 0.999}}, [](std::span<const double> p, std::size_t) { return p[0]; }, outcomes);
  EXPECT_NEAR(fit.value("p"), 0.3, 1e-6);
  EXPECT_NEAR(fit.error("p"), std::sqrt(0.3 * 0.7 / 40.0), 1e-5);
  EXPECT_EQ(fit.num_data, 40U);
}

TEST(Fit, SaysWhereTheBestLiesAtAnEnd) {
  const std::vector<double> y{5.0, 5.0, 5.0};
  const Fit fit = least_squares_fit(
      {{"a", "-", 0.0, 2.0}}, [](std::span<const double> p, std::size_t) { return p[0]; }, y);
  EXPECT_TRUE(fit.is_at_end[0]);
  EXPECT_TRUE(std::isnan(fit.error("a")));
  EXPECT_EQ(fit.covariance.size(), 0);
  EXPECT_THROW(fit.value("b"), std::out_of_range);
}

TEST(Fit, FindsTheLowestOfSeveralMinima) {
  const Loss waves = [](std::span<const double> p) { return std::cos(9.0 * p[0]) + 0.1 * std::abs(p[0] - 2.44346); };
  const Fit fit = likelihood_fit({{"x", "-", 0.0, 5.0}}, waves, 1);
  EXPECT_NEAR(fit.value("x"), 2.44346, 1e-4);  // 7 pi/9
}

TEST(Fit, RefitsFromAGuess) {
  const std::vector<double> x{1.0, 2.0, 4.0, 8.0};
  std::vector<double> y;
  for (const double at : x) y.push_back(3.0 * std::pow(at, -0.7));
  const Law law = [&](std::span<const double> p, std::size_t i) { return p[0] * std::pow(x[i], p[1]); };
  const auto values = refit({{"c", "-", 0.1, 100.0, true}, {"n", "-", -3.0, 3.0}}, law, y, {2.0, -0.5});
  EXPECT_NEAR(values[0], 3.0, 0.01);
  EXPECT_NEAR(values[1], -0.7, 0.005);
}

TEST(Fit, RefusesFewerDataThanParameters) {
  const std::vector<double> y{1.0};
  const Law law = [](std::span<const double> p, std::size_t) { return p[0] + p[1]; };
  EXPECT_THROW(least_squares_fit({{"a", "-"}, {"b", "-"}}, law, y), std::invalid_argument);
}

}  // namespace
}  // namespace knap
