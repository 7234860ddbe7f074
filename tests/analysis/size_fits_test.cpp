#include "analysis/size_fits.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace knap {
namespace {

TEST(SizeFits, SievesFallByTheFourthRootOfTwo) {
  const auto sieves = sieve_series(1e-3, 1e-4);
  ASSERT_EQ(sieves.size(), 14U);
  EXPECT_DOUBLE_EQ(sieves[0], 1e-3);
  EXPECT_NEAR(sieves[4], 0.5e-3, 1e-12);
  EXPECT_GE(sieves.back(), 1e-4);
}

TEST(SizeFits, WhatPassesIsUpToAndWithTheSieve) {
  const std::vector<SizeRow> rows{{1e-4, 0.1, 5}, {2e-4, 0.3, 8}, {9e-4, 1.0, 9}};
  const std::vector<double> sieves{1e-3, 9e-4, 5e-4, 2e-4, 1.5e-4, 0.5e-4};
  EXPECT_EQ(passing(rows, sieves), (std::vector<double>{1.0, 1.0, 0.3, 0.3, 0.1, 0.0}));
}

TEST(SizeFits, LawsAreFound) {
  std::vector<double> sizes, rosin, gates;
  for (const double size : sieve_series(1e-3, 1e-4)) {
    sizes.push_back(size);
    rosin.push_back(1.0 - std::exp(-std::pow(size / 0.6e-3, 1.7)));
    gates.push_back(std::pow(size / 1.4e-3, 0.9));
  }
  const Fit rr = fit_rosin_rammler(sizes, rosin);
  EXPECT_NEAR(rr.value("x63"), 0.6e-3, 1e-8);
  EXPECT_NEAR(rr.value("n"), 1.7, 1e-4);
  const Fit ggs = fit_gates_gaudin_schuhmann(sizes, gates);
  EXPECT_NEAR(ggs.value("k"), 1.4e-3, 1e-8);
  EXPECT_NEAR(ggs.value("m"), 0.9, 1e-4);
}

}  // namespace
}  // namespace knap
