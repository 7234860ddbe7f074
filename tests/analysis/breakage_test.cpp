#include "analysis/breakage.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "box_mesh.hpp"

namespace knap {
namespace {

constexpr ParticleScale particle{.mass = 1.0, .diameter = 1.0, .element_size = 0.06};
constexpr double round_off = 1e-12;

/// Pieces of a particle of unit mass; the sieve size of a piece is the cube root of its mass.
std::vector<Fragment> pieces(std::vector<double> masses, Index num_tets = 100) {
  std::sort(masses.begin(), masses.end(), std::greater<>());
  std::vector<Fragment> fragments;
  for (const double mass : masses) {
    Fragment fragment;
    fragment.id = to_index(fragments.size());
    fragment.mass = mass;
    fragment.num_tets = num_tets;
    fragment.sieve_size = std::cbrt(mass);
    fragments.push_back(fragment);
  }
  return fragments;
}

BreakageClass class_of(const std::vector<double>& masses) {
  return breakage_measures(pieces(masses), particle).breakage_class;
}

TEST(BreakageMeasures, CountsAndFractionsAddUp) {
  auto fragments = pieces({0.6, 0.2, 0.1, 0.05, 0.02, 0.012, 0.01, 0.005, 0.002, 0.0007, 0.0003});
  fragments[9].num_tets = 9;
  fragments[10].num_tets = 1;
  fragments[8].num_tets = 10;
  const BreakageMeasures measures = breakage_measures(fragments, particle);
  EXPECT_EQ(measures.count, 11);
  EXPECT_EQ(measures.count_above_1pct, 6);
  EXPECT_EQ(measures.count_above_0p1pct, 9);
  EXPECT_NEAR(measures.largest_mass_fraction, 0.6, round_off);
  EXPECT_NEAR(measures.second_mass_fraction, 0.2, round_off);
  EXPECT_NEAR(measures.chipping_ratio, 0.4, round_off);
  EXPECT_NEAR(measures.unresolved_mass_fraction, 0.001, round_off);
  EXPECT_NEAR(measures.mass_sum_fraction, 1.0, round_off);
}

TEST(BreakageMeasures, IntactParticleHasNothingFiner) {
  const BreakageMeasures measures = breakage_measures(pieces({1.0}), particle);
  EXPECT_EQ(measures.count, 1);
  EXPECT_EQ(measures.chipping_ratio, 0.0);
  EXPECT_EQ(measures.second_mass_fraction, 0.0);
  EXPECT_EQ(measures.breakage_class, BreakageClass::Intact);
  for (const FinerFraction& finer : measures.finer) EXPECT_EQ(finer.fraction, 0.0);
}

TEST(BreakageMeasures, FinerFractionsAreThoseOfTheSieves) {
  // Sizes 0.9, 0.45, 0.2, 0.09, 0.03 against sieves 1/2, 1/4, 1/10, 1/25 = 0.04, 1/50 = 0.02, 1/75.
  auto fragments = pieces({0.5, 0.25, 0.125, 0.1, 0.025});
  const std::array<double, 5> sizes{0.9, 0.45, 0.2, 0.09, 0.03};
  for (std::size_t i = 0; i < sizes.size(); ++i) fragments[i].sieve_size = sizes[i];
  const BreakageMeasures measures = breakage_measures(fragments, particle);
  const std::array<double, 6> expected{0.5, 0.25, 0.125, 0.025, 0.0, 0.0};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(measures.finer[i].divisor, fineness_divisors[i]);
    EXPECT_NEAR(measures.finer[i].fraction, expected[i], round_off);
    EXPECT_EQ(measures.finer[i].resolved, fineness_divisors[i] <= 10);  // the element size is 0.06
  }
}

TEST(BreakageMeasures, ClassesFollowTheRule) {
  EXPECT_EQ(class_of({1.0}), BreakageClass::Intact);
  EXPECT_EQ(class_of({0.9995, 0.0005}), BreakageClass::Intact);
  EXPECT_EQ(class_of({0.998, 0.002}), BreakageClass::Chipped);
  EXPECT_EQ(class_of({0.91, 0.09}), BreakageClass::Chipped);
  EXPECT_EQ(class_of({0.88, 0.12}), BreakageClass::Split);
  EXPECT_EQ(class_of({0.5, 0.49, 0.01}), BreakageClass::Split);
  EXPECT_EQ(class_of({0.2, 0.2, 0.2, 0.2, 0.09, 0.09, 0.02}), BreakageClass::Split);
  EXPECT_EQ(class_of({0.2, 0.2, 0.2, 0.2, 0.2}), BreakageClass::Fragmented);
  EXPECT_EQ(class_of({0.35, 0.35, 0.09, 0.09, 0.09, 0.03}), BreakageClass::Fragmented);
  EXPECT_EQ(class_of({0.7, 0.08, 0.08, 0.08, 0.06}), BreakageClass::Fragmented);
}

TEST(BreakageMeasures, ClassNeverFallsWhileDebrisGrows) {
  // A survivor that is ground down to dust goes through intact, chipped and fragmented and never back.
  BreakageClass last = BreakageClass::Intact;
  for (int percent = 100; percent > 0; --percent) {
    std::vector<double> masses(at(100 - percent), 0.01);
    masses.push_back(0.01 * percent);
    const BreakageClass now = class_of(masses);
    EXPECT_GE(now, last);
    last = now;
  }
  EXPECT_EQ(last, BreakageClass::Fragmented);
}

TEST(BreakageMeasures, NamesOfClasses) {
  EXPECT_EQ(name(BreakageClass::Intact), "intact");
  EXPECT_EQ(name(BreakageClass::Chipped), "chipped");
  EXPECT_EQ(name(BreakageClass::Split), "split");
  EXPECT_EQ(name(BreakageClass::Fragmented), "fragmented");
}

TEST(BreakageMeasures, MassThatWentLostShows) {
  const BreakageMeasures measures = breakage_measures(pieces({0.5, 0.3}), particle);
  EXPECT_NEAR(measures.mass_sum_fraction, 0.8, round_off);
  EXPECT_NEAR(measures.chipping_ratio, 0.5, round_off);
  EXPECT_EQ(breakage_measures({}, particle).breakage_class, BreakageClass::Fragmented);
}

TEST(BreakageMeasures, HalvedBoxIsSplit) {
  MovingMesh mesh(box_mesh({2.0, 1.0, 1.0}, {4, 2, 2}));
  for (Index tet = 0; tet < mesh.topology.num_tets(); ++tet) mesh.label[at(tet)] = mesh.tet_centre(tet).x() < 1.0;
  const auto fragments = find_fragments(mesh.input(3.0));
  const BreakageMeasures measures = breakage_measures(fragments, {.mass = 6.0, .diameter = 2.4, .element_size = 0.5});
  EXPECT_EQ(measures.breakage_class, BreakageClass::Split);
  EXPECT_NEAR(measures.largest_mass_fraction, 0.5, round_off);
  EXPECT_NEAR(measures.finer[0].fraction, 1.0, round_off);  // both halves are unit cubes, d/2 = 1.2
  EXPECT_NEAR(measures.finer[1].fraction, 0.0, round_off);
}

TEST(SizeDistribution, IsAscendingAndEndsAtTheWholeMass) {
  const auto rows = size_distribution(pieces({0.4, 0.2, 0.2, 0.1, 0.1}), particle);
  ASSERT_EQ(rows.size(), 3u);  // equal sizes share a row
  EXPECT_NEAR(rows[0].sieve_size, std::cbrt(0.1), round_off);
  EXPECT_NEAR(rows[0].finer_fraction, 0.2, round_off);
  EXPECT_EQ(rows[0].finer_count, 2);
  EXPECT_NEAR(rows[1].finer_fraction, 0.6, round_off);
  EXPECT_EQ(rows[1].finer_count, 4);
  EXPECT_NEAR(rows[2].finer_fraction, 1.0, round_off);
  EXPECT_EQ(rows[2].finer_count, 5);
  EXPECT_TRUE(size_distribution({}, particle).empty());
}

}  // namespace
}  // namespace knap
