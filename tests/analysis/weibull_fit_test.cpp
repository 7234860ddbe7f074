#include "analysis/weibull_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

namespace knap {
namespace {

// The quantiles of the distribution at the ranks' probabilities: a sample without scatter.
std::vector<double> quantiles(double modulus, double scale, int n) {
  std::vector<double> samples;
  for (int i = 0; i < n; ++i) samples.push_back(scale * std::pow(-std::log1p(-(i + 0.5) / n), 1.0 / modulus));
  return samples;
}

TEST(WeibullFit, FindsTheParametersOfQuantiles) {
  for (const double modulus : {0.7, 3.0, 9.0, 40.0}) {
    const WeibullFit fit = fit_weibull(quantiles(modulus, 8.3e6, 4000));
    EXPECT_NEAR(fit.modulus, modulus, 0.003 * modulus);  // the ranks cut the tails: 0.1 % at 4000
    EXPECT_NEAR(fit.scale, 8.3e6, 0.001 * 8.3e6 / std::min(1.0, modulus));
  }
}

// For exponentially distributed samples, modulus 1, the likeliest scale at the likeliest modulus obeys both equations
// of the maximum: sum (x/s)^m = n and n/m + sum ln(x/s) (1 - (x/s)^m) = 0.
TEST(WeibullFit, IsWhereTheDerivativesOfTheLikelihoodVanish) {
  const std::vector<double> samples{1.3, 0.2, 4.1, 2.2, 0.9, 7.7, 1.1};
  const WeibullFit fit = fit_weibull(samples);
  double of_scale = 0.0, of_modulus = 0.0;
  for (const double x : samples) {
    const double log = std::log(x / fit.scale);
    of_scale += std::exp(fit.modulus * log) - 1.0;
    of_modulus += 1.0 / fit.modulus + log * (1.0 - std::exp(fit.modulus * log));
  }
  EXPECT_NEAR(of_scale, 0.0, 1e-12);
  EXPECT_NEAR(of_modulus, 0.0, 1e-12);
}

// Over many samples of 20 the estimates scatter by what modulus_error says, to the third that so few samples add, and
// their mean is biased by a factor of 1.08 (Thoman, Bain & Antle 1969, table for n = 20: 0.931 unbiases).
TEST(WeibullFit, ScattersAsItsErrorSays) {
  constexpr double modulus = 5.0;
  constexpr int trials = 2000, n = 20;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  double sum = 0.0, squares = 0.0, error = 0.0;
  for (int trial = 0; trial < trials; ++trial) {
    std::vector<double> samples;
    for (int i = 0; i < n; ++i) samples.push_back(std::pow(-std::log1p(-uniform(random)), 1.0 / modulus));
    const WeibullFit fit = fit_weibull(samples);
    sum += fit.modulus;
    squares += fit.modulus * fit.modulus;
    error += fit.modulus_error;
  }
  const double mean = sum / trials;
  EXPECT_NEAR(mean, modulus / 0.931, 0.02 * modulus);
  const double scatter = std::sqrt(squares / trials - mean * mean);
  EXPECT_GT(scatter, error / trials);
  EXPECT_LT(scatter, 1.33 * error / trials);
}

TEST(WeibullFit, IsTheSameInOtherUnits) {
  const std::vector<double> samples{1.3, 0.2, 4.1, 2.2}, larger{1.3e9, 0.2e9, 4.1e9, 2.2e9};
  EXPECT_NEAR(fit_weibull(larger).modulus, fit_weibull(samples).modulus, 1e-12);
  EXPECT_NEAR(fit_weibull(larger).scale, 1e9 * fit_weibull(samples).scale, 1.0);
}

TEST(WeibullFit, EqualSamplesHaveNoScatter) {
  const WeibullFit fit = fit_weibull(std::vector{3.0, 3.0, 3.0});
  EXPECT_TRUE(std::isinf(fit.modulus));
  EXPECT_EQ(fit.scale, 3.0);
}

TEST(WeibullFit, RefusesWhatIsNoStrength) {
  EXPECT_THROW(fit_weibull(std::vector{3.0}), std::invalid_argument);
  EXPECT_THROW(fit_weibull(std::vector{3.0, 0.0}), std::invalid_argument);
  EXPECT_THROW(fit_weibull(std::vector{3.0, std::nan("")}), std::invalid_argument);
}

TEST(Ranked, ProbabilitiesAreTheMiddlesOfTheSteps) {
  const auto samples = ranked(std::vector{3.0, 1.0, 2.0, 4.0});
  ASSERT_EQ(samples.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(samples[i].value, static_cast<double>(i + 1));
    EXPECT_EQ(samples[i].probability, (static_cast<double>(i) + 0.5) / 4.0);
  }
}

}  // namespace
}  // namespace knap
