#include "analysis/breakage_functions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace knap {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

// Many particles that break with a probability.
template <class Probability>
std::vector<EnergyImpact> drawn(const Probability& probability, double highest) {
  std::mt19937_64 random(7);
  std::vector<EnergyImpact> impacts;
  for (int i = 1; i <= 3000; ++i) {
    const double energy = highest * (i % 60 + 1) / 60.0;
    impacts.push_back({energy, uniform(random) < probability(energy), std::nan("")});
  }
  return impacts;
}

void expect_found(const Fit& fit, const std::string& name, double truth) {
  ASSERT_TRUE(std::isfinite(fit.error(name))) << name;
  EXPECT_NEAR(fit.value(name), truth, 3.0 * fit.error(name)) << name;
  EXPECT_LT(fit.error(name), 0.2 * truth) << name;
}

TEST(BreakageFunctions, VogelPeukertIsFound) {
  EXPECT_EQ(vogel_peukert(50.0, 0.01, 60.0), 0.0);
  EXPECT_NEAR(vogel_peukert(160.0, 0.01, 60.0), 1.0 - std::exp(-1.0), 1e-12);
  EXPECT_NEAR(vogel_peukert(160.0, 0.01, 60.0, 2.0), 1.0 - std::exp(-2.0), 1e-12);
  const Fit fit = fit_vogel_peukert(drawn([](double w) { return vogel_peukert(w, 0.008, 100.0); }, 450.0));
  EXPECT_NEAR(fit.value("f_x"), 0.008, 0.0008);
  EXPECT_NEAR(fit.value("W_min"), 100.0, 8.0);
  EXPECT_NEAR(fit.value("f_x"), 0.008, 3.0 * fit.error("f_x"));
}

TEST(BreakageFunctions, AKinkHasNoStandardError) {
  // None of six breaks at 128 J/kg, four at the next two energies: the best W_min is 128, where the likelihood has a
  // kink.
  std::vector<EnergyImpact> impacts;
  const auto add = [&](double energy, int broken) {
    for (int i = 0; i < 6; ++i) impacts.push_back({energy, i < broken, std::nan("")});
  };
  add(98.0, 0), add(128.0, 0), add(162.0, 4), add(200.0, 4), add(242.0, 6);
  const Fit fit = fit_vogel_peukert(impacts);
  EXPECT_NEAR(fit.value("W_min"), 128.0, 0.01);
  EXPECT_TRUE(fit.is_kinked[1]);
  EXPECT_TRUE(std::isnan(fit.error("W_min")));
}

TEST(BreakageFunctions, ShiKojovicIsFound) {
  std::vector<EnergyImpact> impacts;
  for (int i = 0; i <= 40; ++i) {
    const double w = 10.0 * i;
    impacts.push_back({w, false, 0.3 * vogel_peukert(w, 0.01, 80.0) + 0.002 * std::sin(37.0 * i)});
  }
  impacts.push_back({500.0, true, std::nan("")});  // not resolved: left out
  const Fit fit = fit_shi_kojovic(impacts);
  EXPECT_EQ(fit.num_data, 41U);
  expect_found(fit, "M", 0.3);
  expect_found(fit, "f_x", 0.01);
  expect_found(fit, "W_min", 80.0);
}

TEST(BreakageFunctions, TavaresIsFound) {
  // An upper end makes what is near it break for sure.
  EXPECT_DOUBLE_EQ(tavares_probability(100.0, 100.0, 0.8, infinity), 0.5);
  EXPECT_EQ(tavares_probability(400.0, 100.0, 0.8, 4.0), 1.0);
  EXPECT_NEAR(tavares_probability(100.0, 100.0, 0.8, 4.0),
              0.5 * (1.0 + std::erf(std::log(4.0 / 3.0) / (std::sqrt(2.0) * 0.8))), 1e-12);
  const Fit fit = fit_tavares(drawn([](double e) { return tavares_probability(e, 120.0, 0.5, infinity); }, 450.0));
  expect_found(fit, "E50", 120.0);
  expect_found(fit, "sigma", 0.5);
}

TEST(BreakageFunctions, TavaresT10IsFound) {
  // Where all break, the median of those that break is E50; below, it is less.
  EXPECT_NEAR(median_broken_energy(1e5, 100.0, 0.4), 100.0, 1e-6);
  EXPECT_LT(median_broken_energy(100.0, 100.0, 0.4), 80.0);
  std::vector<EnergyImpact> impacts;
  for (int i = 1; i <= 40; ++i) {
    const double w = 20.0 * i, e50b = median_broken_energy(w, 100.0, 0.4);
    impacts.push_back({w, true, 0.533 * (1.0 - std::exp(-0.3 * w / e50b)) + 0.003 * std::sin(41.0 * i)});
  }
  const Fit fit = fit_tavares_t10(impacts, 100.0, 0.4);
  expect_found(fit, "A", 0.533);
  expect_found(fit, "b'", 0.3);
}

TEST(BreakageFunctions, DamageSolvesItsEquation) {
  for (const double gamma : {2.0, 5.4, 12.0})
    for (const double part : {0.1, 0.5, 0.9, 0.99}) {
      const double d = tavares_damage(part, 1.0, gamma);
      EXPECT_GT(d, 0.0);
      EXPECT_LT(d, 1.0);
      EXPECT_NEAR(d, std::pow(2.0 * gamma / (2.0 * gamma - 5.0 * d + 5.0) * part, 0.4 * gamma), 1e-9) << gamma << part;
    }
  EXPECT_EQ(tavares_damage(2.0, 1.0, 5.4), 1.0);
  EXPECT_EQ(impacts_to_break(2.0, 1.0, 5.4, 10), 1);
  EXPECT_EQ(impacts_to_break(0.01, 1.0, 5.4, 10), 11);
  int before = 1;
  for (const double part : {0.95, 0.7, 0.5, 0.3}) {  // weaker impacts, more of them
    const int n = impacts_to_break(part, 1.0, 5.4, 1000);
    EXPECT_GT(n, before);
    before = n;
  }
}

TEST(BreakageFunctions, DamageIsFound) {
  std::mt19937_64 random(3);
  std::vector<RepeatedImpacts> particles;
  for (int i = 0; i < 600; ++i) {
    const double normal =
        std::sqrt(-2.0 * std::log(uniform(random))) * std::cos(2.0 * 3.14159265358979 * uniform(random));
    const double strength = 100.0 * std::exp(0.4 * normal), energy = 40.0 + 10.0 * (i % 5);
    constexpr int most = 6;
    const int n = impacts_to_break(energy, strength, 5.4, most);
    particles.push_back({energy, std::min(n, most), n <= most});
  }
  expect_found(fit_damage(particles, 100.0, 0.4), "gamma", 5.4);
}

TEST(BreakageFunctions, WeibullInSpeedIsFound) {
  std::mt19937_64 random(11);
  std::vector<double> speeds;
  std::vector<bool> outcomes;
  for (int i = 0; i < 2000; ++i) {
    speeds.push_back(10.0 + (i % 20));
    outcomes.push_back(uniform(random) < 1.0 - std::exp(-std::pow(speeds.back() / 20.0, 6.0)));
  }
  const Fit fit = fit_speed_weibull(speeds, outcomes);
  expect_found(fit, "v_s", 20.0);
  expect_found(fit, "m", 6.0);
}

TEST(BreakageFunctions, AJumpFromNoneToAllLeavesTheWidthOpen) {
  std::vector<double> speeds;
  std::vector<bool> outcomes;
  for (int i = 0; i < 30; ++i) speeds.push_back(10.0 + i % 10), outcomes.push_back(i % 10 > 4);
  const Fit fit = fit_speed_weibull(speeds, outcomes);
  EXPECT_TRUE(fit.is_at_end[1]);
  EXPECT_GT(fit.value("v_s"), 14.0);
  EXPECT_LT(fit.value("v_s"), 15.1);
  EXPECT_TRUE(std::isnan(fit.error("m")));
}

}  // namespace
}  // namespace knap
