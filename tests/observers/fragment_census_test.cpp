#include "observers/fragment_census.hpp"

#include <gmock/gmock.h>

#include "tests/observers/breaking_box.hpp"

namespace knap {
namespace {

using testing::AllOf;
using testing::Each;
using testing::Ge;
using testing::Le;

TEST(FragmentCensus, NothingIsCrackedAtTheStart) {
  const Simulation s = breaking_box();
  const CrackCensus census = crack_census(s);
  EXPECT_EQ(census.area, 0.0);
  EXPECT_EQ(census.failed_area, 0.0);
  EXPECT_EQ(count_fragments(s, FragmentLabel::Damage), 1);
  EXPECT_THAT(tet_damage(s), Each(0.0));
  EXPECT_DOUBLE_EQ(rebound(s).normal, -1.0);
  EXPECT_DOUBLE_EQ(rebound(s).tangential, 1.0);
}

TEST(FragmentCensus, AreasOfABrokenBoxAgree) {
  Simulation s = breaking_box();
  advance(s, 300);
  ASSERT_GT(s.totals.inserted_facets, 20);
  const CrackCensus census = crack_census(s);
  double inserted = 0.0;
  for (Index facet = 0; facet < s.topology.num_facets(); ++facet)
    if (s.topology.facet_state[at(facet)] != FacetState::Bonded) inserted += s.reference.facet_area[at(facet)];
  EXPECT_NEAR(census.area, inserted, 1e-12 * inserted);
  EXPECT_NEAR(census.area_mode_i + census.area_mode_ii, census.area, 1e-12 * inserted);
  EXPECT_GT(census.area_mode_ii, 0.0);
  EXPECT_GT(census.failed_area, 0.0);
  EXPECT_LT(census.failed_area, census.area);
  EXPECT_LE(count_fragments(s, FragmentLabel::Strict), count_fragments(s, FragmentLabel::Damage));
}

TEST(FragmentCensus, DamageIsOneWhereAFacetHasFailed) {
  Simulation s = breaking_box();
  advance(s, 300);
  const auto damage = facet_damage(s);
  EXPECT_THAT(damage, Each(AllOf(Ge(0.0), Le(1.0))));
  for (Index facet = 0; facet < s.topology.num_facets(); ++facet) {
    const FacetState state = s.topology.facet_state[at(facet)];
    const bool broken = state == FacetState::Failed || state == FacetState::HandedOver;
    if (state == FacetState::Cohesive) continue;
    EXPECT_EQ(damage[at(facet)], broken ? 1.0 : 0.0);
  }
}

TEST(FragmentCensus, MomentumIsAccountedFor) {
  Simulation s = breaking_box();
  advance(s, 300);
  const MomentumErrors errors = momentum_errors(s, 0.6e-3);
  EXPECT_LE(errors.linear, 1e-12);
  EXPECT_LE(errors.angular, 1e-4);
}

}  // namespace
}  // namespace knap
