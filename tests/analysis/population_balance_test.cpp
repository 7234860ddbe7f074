#include "analysis/population_balance.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace knap {
namespace {

TEST(PopulationBalance, BreakageOfTheWholeIsOne) {
  for (const double q : {0.3, 1.0, 2.5})
    for (const double r : {0.1, 0.8, 3.0}) {
      EXPECT_DOUBLE_EQ(breakage_distribution(1.0, q, r), 1.0);
      EXPECT_EQ(breakage_distribution(0.0, q, r), 0.0);
      EXPECT_NEAR(breakage_distribution(1.0 - 1e-12, q, r), 1.0, 1e-10);  // no step at the end
      for (double z = 0.05; z < 1.0; z += 0.05)
        EXPECT_LT(breakage_distribution(z, q, r), breakage_distribution(z + 0.05, q, r) + 1e-15);
    }
  // As printed, over its value at 1: z = r gives z^q/2.
  EXPECT_NEAR(breakage_distribution(0.5, 2.0, 0.5), 0.125 / (0.5 * (1.0 + std::tanh(1.0))), 1e-12);
}

TEST(PopulationBalance, AStepConservesMass) {
  const SizeClasses classes{{2e-3, 1e-3, 0.5e-3, 0.25e-3, 0.1e-3}};
  const Eigen::MatrixXd breakage =
      breakage_matrix(classes, [](double z) { return breakage_distribution(z, 0.8, 0.4); });
  for (Eigen::Index j = 0; j < breakage.cols(); ++j) {
    EXPECT_NEAR(breakage.col(j).sum(), 1.0, 1e-14);
    EXPECT_GE(breakage.col(j).minCoeff(), 0.0);
    for (Eigen::Index i = 0; i < j; ++i) EXPECT_EQ(breakage(i, j), 0.0);  // nothing grows
  }
  Eigen::VectorXd masses(5), selection(5);
  masses << 1.0, 2.0, 0.5, 0.0, 0.3;
  selection << 0.9, 0.5, 0.1, 0.0, 0.0;
  const Eigen::VectorXd after = ground(masses, selection, breakage);
  EXPECT_NEAR(after.sum(), masses.sum(), 1e-14);
  EXPECT_LT(after[0], masses[0]);
  EXPECT_GT(after[4], masses[4]);
  // The coarsest class by hand: it keeps what is not selected, and what stays coarse of what is.
  EXPECT_NEAR(after[0], 0.1 + 0.9 * (1.0 - breakage_distribution(0.5, 0.8, 0.4)), 1e-14);
}

TEST(PopulationBalance, MeasuredPointsAreJoinedByPowers) {
  const std::vector<double> at{0.1, 0.2, 0.8, 1.0}, finer{0.1, 0.2, 0.4, 1.0};
  EXPECT_NEAR(measured_distribution(0.15, at, finer), 0.15, 1e-12);
  EXPECT_NEAR(measured_distribution(0.4, at, finer), 0.2 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(measured_distribution(0.05, at, finer), 0.05, 1e-12);
  EXPECT_EQ(measured_distribution(1.0, at, finer), 1.0);
  EXPECT_EQ(measured_distribution(0.0, at, finer), 0.0);
  // Two halves and nothing finer.
  const std::vector<double> halves{0.0, 0.0, 0.5, 1.0};
  const SizeClasses classes{{1.0, 0.8, 0.2, 0.1}};
  const Eigen::MatrixXd breakage =
      breakage_matrix(classes, [&](double z) { return measured_distribution(z, at, halves); });
  EXPECT_TRUE(breakage.allFinite());
  EXPECT_GE(breakage.minCoeff(), 0.0);
}

TEST(PopulationBalance, TwoTermsAreFound) {
  std::vector<double> z, finer;
  for (double at = 0.05; at <= 1.0; at += 0.05)
    z.push_back(at), finer.push_back(austin_distribution(at, 0.15, 0.4, 5.0));
  const Fit fit = fit_austin(z, finer);
  EXPECT_NEAR(fit.value("phi"), 0.15, 1e-4);
  EXPECT_NEAR(fit.value("g"), 0.4, 1e-3);
  EXPECT_NEAR(fit.value("b"), 5.0, 1e-2);
  EXPECT_DOUBLE_EQ(austin_distribution(1.0, 0.15, 0.4, 5.0), 1.0);
}

TEST(PopulationBalance, DistributionIsFound) {
  std::vector<double> z, finer;
  for (double at = 0.05; at <= 1.0; at += 0.05) z.push_back(at), finer.push_back(breakage_distribution(at, 0.7, 0.35));
  const Fit fit = fit_breakage_distribution(z, finer);
  EXPECT_NEAR(fit.value("q"), 0.7, 1e-4);
  EXPECT_NEAR(fit.value("r"), 0.35, 1e-4);
}

}  // namespace
}  // namespace knap
