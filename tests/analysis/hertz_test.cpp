#include "analysis/hertz.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace knap {
namespace {

const HertzImpact zeolite{
    .reduced_modulus = 2.45e9 / (1.0 - 0.0625), .density = 1270.0, .diameter = 1.64e-3, .speed = 15.0};

TEST(Hertz, PeakForceIsTheStaticLawAtTheLargestApproach) {
  // Energy balance, an independent way to the approach: m v^2 / 2 = 8/15 E* sqrt(R) delta^(5/2).
  const double radius = 0.82e-3;
  const double mass = 4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3) * zeolite.density;
  const double stored =
      8.0 / 15.0 * zeolite.reduced_modulus * std::sqrt(radius) * std::pow(largest_approach(zeolite), 2.5);
  EXPECT_NEAR(stored / (0.5 * mass * 225.0), 1.0, 1e-12);
  EXPECT_NEAR(contact_radius(zeolite), std::sqrt(radius * largest_approach(zeolite)), 1e-15);
}

TEST(Hertz, ScaleFreeFormsOfTheLiteratureHold) {
  const double inertia = zeolite.density * 225.0;
  const double force = 0.7574 * std::pow(zeolite.reduced_modulus, 0.4) * std::pow(inertia, 0.6) * 1.64e-3 * 1.64e-3;
  EXPECT_NEAR(peak_force(zeolite) / force, 1.0, 1e-4);  // 0.7574 is printed with four digits
  const double radius = std::pow(5.0 * std::numbers::pi * inertia / (4.0 * zeolite.reduced_modulus), 0.2) * 0.82e-3;
  EXPECT_NEAR(contact_radius(zeolite) / radius, 1.0, 1e-12);
}

TEST(Hertz, ContactTimeIsTheIntegralOfTheMotion) {
  // t = 2 delta / v times the integral of dx / sqrt(1 - x^(5/2)) over [0, 1]; x = 1 - s^2 takes the root's pole away.
  constexpr int n = 20000;
  double integral = 0.0;
  for (int i = 0; i < n; ++i) {
    const double s = (i + 0.5) / n;
    integral += 2.0 * s / std::sqrt(1.0 - std::pow(1.0 - s * s, 2.5)) / n;
  }
  EXPECT_NEAR(contact_time(zeolite) / (2.0 * integral * largest_approach(zeolite) / 15.0), 1.0, 1e-4);
  HertzImpact still = zeolite;
  still.speed = 0.0;
  EXPECT_EQ(contact_time(still), 0.0);
}

TEST(Hertz, CriticalSpeedsOfTheGranulesAreThoseOfTheirFractureForces) {
  // Speeds at which the peak force is the measured fracture force: 16.4 m/s (zeolite, 24.9 N at 1.64 mm) and 22.9 m/s
  // (gamma-alumina, 34.49 N at 1.09 mm); with the skeletal densities 12.5 and 15.1 m/s.
  const HertzImpact alumina{.reduced_modulus = 12.23e9 / (1.0 - 0.09), .density = 1470.0, .diameter = 1.09e-3};
  const double zeolite_strength = 0.9 * 24.9 / std::pow(1.64e-3, 2);
  const double alumina_strength = 0.9 * 34.49 / std::pow(1.09e-3, 2);
  EXPECT_NEAR(critical_speed(zeolite, zeolite_strength), 16.4, 0.05);
  EXPECT_NEAR(critical_speed(alumina, alumina_strength), 22.9, 0.05);
  EXPECT_NEAR(critical_speed(zeolite, 8.34e6), 16.4, 0.05);  // the printed strength
  HertzImpact skeletal = zeolite;
  skeletal.density = 2180.0;
  EXPECT_NEAR(critical_speed(skeletal, zeolite_strength), 12.5, 0.05);
  skeletal = alumina;
  skeletal.density = 3370.0;
  EXPECT_NEAR(critical_speed(skeletal, alumina_strength), 15.1, 0.05);
}

TEST(Hertz, StressAtTheCriticalSpeedIsTheStrengthForAnyDiameter) {
  for (const double diameter : {0.5e-3, 2e-3, 50e-3}) {
    HertzImpact impact = zeolite;
    impact.diameter = diameter;
    impact.speed = critical_speed(impact, 8.34e6);
    EXPECT_NEAR(0.9 * peak_force(impact) / (diameter * diameter), 8.34e6, 1.0);
  }
}

}  // namespace
}  // namespace knap
