#include "analysis/sanity_card.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>

namespace knap {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

/// Zeolite 4AK of 1.64 mm on the wall at 15 m/s, a mesh of about 20k tets.
SanityInput zeolite() {
  return {.young_modulus = 2.45e9,
          .poisson_ratio = 0.25,
          .density = 1270.0,
          .fracture = FractureScale{.strength = 8.34e6, .fracture_energy = 8.6, .shear_strength_ratio = 1.5},
          .diameter = 1.64e-3,
          .volume = std::numbers::pi / 6.0 * std::pow(1.64e-3, 3),
          .speed = 15.0,
          .angle = std::numbers::pi / 2.0,
          .contact_element_size = 40e-6,
          .element_size = 98e-6,
          .num_tets = 20000,
          .time_step = TimeStepScale{.dt = 5e-9, .limited_by = "the smallest element"},
          .cost_per_tet_step = 20e-9};
}

TEST(SanityCard, LengthsAreThoseOfTheCohesiveLaw) {
  const SanityCard card = sanity_card(zeolite());
  ASSERT_TRUE(card.fracture);
  // l_ch = (K_IC / sigma_c)^2 with K_IC^2 = E' G_c: about 0.15 MPa sqrt(m), the low end of zeolite's toughness.
  const double toughness = std::sqrt(2.45e9 / 0.9375 * 8.6);
  EXPECT_NEAR(toughness, 0.15e6, 0.001e6);
  EXPECT_NEAR(card.fracture->characteristic_length, std::pow(toughness / 8.34e6, 2), 1e-12);
  EXPECT_NEAR(card.fracture->cohesive_zone.length, 0.88 * card.fracture->characteristic_length, 1e-15);
  EXPECT_NEAR(card.fracture->cohesive_zone.elements(), 2.9, 0.05);
  EXPECT_NEAR(card.fracture->shear_zone.length, card.fracture->characteristic_length / 2.25, 1e-15);
  EXPECT_NEAR(card.fracture->shear_zone.elements(), 3.6, 0.05);
  EXPECT_NEAR(card.fracture->final_opening, 2.062e-6, 1e-9);
  EXPECT_NEAR(card.fracture->critical_speed, 16.4, 0.05);
}

// N springs in series that soften linearly with one slip delta_c each, pulled until one has let go.
double energy_of_series(int facets, int steps) {
  double energy = 0.0, slip = 0.0;  // of G, in delta_c
  const double end = 1.0 / facets;  // all together
  for (int i = 0; i < steps; ++i, slip += end / steps)
    energy += 2.0 * (1.0 - slip - 0.5 * end / steps) * facets * end / steps;
  for (int i = 0; i < steps; ++i, slip += (1.0 - end) / steps)
    energy += 2.0 * (1.0 - slip - 0.5 * (1.0 - end) / steps) * (1.0 - end) / steps;
  return energy;
}

TEST(SanityCard, FacetsInSeriesTakeUpToThreeTimesTheEnergyOfOne) {
  for (const int facets : {1, 2, 3, 5, 40})
    EXPECT_NEAR(shared_slip_factor(facets), energy_of_series(facets, 1000), 1e-9);
  EXPECT_EQ(shared_slip_factor(0.3), 1.0);
  EXPECT_NEAR(shared_slip_factor(1e6), 3.0, 1e-5);
}

TEST(SanityCard, TheCrushedZoneIsTheShorterOfShearZoneAndContact) {
  SanityInput input = zeolite();
  input.contact_element_size = 20e-6;
  EXPECT_NEAR(crushed_facets(input), 323.1e-6 / 2.25 / 20e-6, 0.01);  // l_ch/beta^2
  input.fracture->fracture_energy = 100.0;  // now the radius at 16.4 m/s, 0.82 mm (5 pi rho v^2/(4 E*))^(1/5)
  EXPECT_NEAR(crushed_facets(input), 180e-6 / 20e-6, 0.1);
  input.contact_element_size = 1.0;
  EXPECT_EQ(crushed_facets(input), 1.0);
}

TEST(SanityCard, CrushedZoneFacetsGiveEveryMeshTheSameEnergyThere) {
  SanityInput input = zeolite();
  input.fracture->mode_ii_ratio = 2.0;
  EXPECT_EQ(sanity_card(input).fracture->mode_ii_ratio, 2.0);
  input.fracture->crushed_zone_facets = 2.0;
  for (const double element_size : {20e-6, 40e-6, 100e-6}) {
    input.contact_element_size = element_size;
    EXPECT_NEAR(sanity_card(input).fracture->crushed_zone_energy, 2.0 * 1.75, 1e-12);
  }
  input.contact_element_size = sanity_card(input).fracture->crushed_facets * 100e-6 / 2.0;
  EXPECT_NEAR(mesh_mode_ii_ratio(input), 2.0, 1e-12);
}

TEST(SanityCard, WaveSpeedsAndTimesAreThoseOfTheSolid) {
  const SanityCard card = sanity_card(zeolite());
  // nu = 1/4: lambda = mu = 0.4 E, so c_p = sqrt(3) c_s = sqrt(1.2 E / rho).
  EXPECT_NEAR(card.p_wave_speed, std::sqrt(1.2 * 2.45e9 / 1270.0), 1e-9);
  EXPECT_NEAR(card.s_wave_speed, card.p_wave_speed / std::numbers::sqrt3, 1e-9);
  EXPECT_NEAR(card.crossing_time, 1.64e-3 / card.p_wave_speed, 1e-18);
  EXPECT_NEAR(card.end_time, 50.0 * card.crossing_time, 1e-15);
  EXPECT_EQ(card.num_steps, std::ceil(card.end_time / 5e-9));
  EXPECT_NEAR(card.wall_time, card.num_steps * 20000 * 20e-9, 1e-9);
}

TEST(SanityCard, SlowImpactOutlastsFiftyCrossings) {
  SanityInput input = zeolite();
  input.speed = 1e-4;
  const SanityCard card = sanity_card(input);
  EXPECT_GT(card.contact_time, 50.0 * card.crossing_time);
  EXPECT_NEAR(card.end_time, card.contact_time + 10.0 * card.crossing_time, 1e-15);
  input.end_time = 1e-5;
  EXPECT_EQ(sanity_card(input).end_time, 1e-5);
}

TEST(SanityCard, ObliqueImpactCountsByItsNormalSpeed) {
  SanityInput oblique = zeolite();
  oblique.speed = 30.0;
  oblique.angle = std::numbers::pi / 6.0;
  EXPECT_NEAR(sanity_card(oblique).contact_radius.length, sanity_card(zeolite()).contact_radius.length, 1e-15);
}

TEST(SanityCard, VerdictsFollowTheNumberOfElements) {
  const auto verdict = [](double elements) {
    return ResolvedLength{.length = elements, .element_size = 1.0, .wanted = 3.0, .least = 2.0}.verdict();
  };
  EXPECT_EQ(verdict(3.0), Verdict::Ok);
  EXPECT_EQ(verdict(2.99), Verdict::Coarse);
  EXPECT_EQ(verdict(2.0), Verdict::Coarse);
  EXPECT_EQ(verdict(1.99), Verdict::Refused);
}

TEST(SanityCardRefusals, ResolvedMeshMayStart) { EXPECT_THAT(refusals(sanity_card(zeolite())), IsEmpty()); }

TEST(SanityCardRefusals, CoarseZoneNamesKeyValueAndOverride) {
  SanityInput input = zeolite();
  input.element_size = 150e-6;
  const auto messages = refusals(sanity_card(input));
  ASSERT_THAT(messages, SizeIs(1));
  EXPECT_THAT(messages[0], HasSubstr("spans 1.9 elements of 150 um"));
  EXPECT_THAT(messages[0], HasSubstr("fracture.allow_unresolved = true"));
  EXPECT_THAT(messages[0], HasSubstr("mesh.element_size = \"94 um\" for 3 elements, \"140 um\" for the 2"));
  input.element_size = 140e-6;
  EXPECT_THAT(refusals(sanity_card(input)), IsEmpty());
  input.element_size = 94e-6;
  const SanityCard mended = sanity_card(input);
  EXPECT_EQ(mended.fracture->cohesive_zone.verdict(), Verdict::Ok);
  EXPECT_THAT(refusals(mended), IsEmpty());
}

TEST(SanityCardRefusals, SmallContactNamesKeyValueAndOverride) {
  SanityInput input = zeolite();
  input.contact_element_size = 98e-6;
  input.speed = 1.0;
  const auto messages = refusals(sanity_card(input));
  ASSERT_THAT(messages, SizeIs(1));
  EXPECT_THAT(messages[0], HasSubstr("mesh.contact_element_size"));
  EXPECT_THAT(messages[0], HasSubstr("fracture.allow_unresolved = true"));
  input.fracture.reset();
  EXPECT_THAT(refusals(sanity_card(input)), SizeIs(1));
  input.speed = 0.0;  // nothing will touch the wall
  EXPECT_THAT(refusals(sanity_card(input)), IsEmpty());
}

TEST(SanityCardRefusals, GlassBeadIsRefusedOnEveryAffordableMesh) {
  SanityInput bead = zeolite();
  bead.young_modulus = 71e9;
  bead.poisson_ratio = 0.23;
  bead.density = 2500.0;
  bead.fracture = FractureScale{
      .strength = 100e6, .fracture_energy = 0.75e6 * 0.75e6 * (1.0 - 0.23 * 0.23) / 71e9, .shear_strength_ratio = 1.5};
  bead.diameter = 2e-3;
  bead.element_size = 33e-6;  // 1M tets
  EXPECT_EQ(sanity_card(bead).fracture->cohesive_zone.verdict(), Verdict::Refused);
  bead.element_size = 16.4e-6;  // 8M tets
  EXPECT_EQ(sanity_card(bead).fracture->cohesive_zone.verdict(), Verdict::Ok);
}

TEST(SanityCardText, ShowsEachNumberWithItsUnitAndVerdict) {
  const std::string text = format_sanity_card(sanity_card(zeolite()));
  for (const char* part : {"1.64 mm", "2.45 GPa", "8.34 MPa", "cohesive zone", "284 um", "2.9 elements of 98 um",
                           "coarse", "(wants 3)", "critical speed", "16.4 m/s", "contact radius", "ok", "1.52 km/s",
                           "time step", "5 ns", "limited by the smallest element", "wall time"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
}

TEST(SanityCardText, ElasticRunHasNoCohesiveLines) {
  SanityInput input = zeolite();
  input.fracture.reset();
  input.time_step.reset();
  const std::string text = format_sanity_card(sanity_card(input));
  for (const char* part : {"cohesive", "shear zone", "critical", "strength", "steps", "wall time"}) {
    EXPECT_THAT(text, Not(HasSubstr(part)));
  }
  EXPECT_THAT(text, HasSubstr("contact radius"));
}

TEST(SanityCardText, ValuesEndInOneColumn) {
  std::istringstream text(format_sanity_card(sanity_card(zeolite())));
  std::string line;
  std::getline(text, line);
  EXPECT_EQ(line, "Sanity card");
  while (std::getline(text, line)) {
    ASSERT_GE(line.size(), 32u);
    EXPECT_NE(line[31], ' ') << line;
    EXPECT_TRUE(line.size() == 32 || line[32] == ' ') << line;
    EXPECT_NE(line.back(), ' ');
  }
}

}  // namespace
}  // namespace knap
