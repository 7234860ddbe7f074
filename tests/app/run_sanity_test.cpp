#include "app/run_sanity.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "app/prepare_run.hpp"
#include "config/load_config.hpp"
#include "meshing/shape.hpp"

namespace knap {
namespace {

SanityCard card(const std::vector<std::string>& overrides) {
  const RunConfig config = config_from_text(
      "[particle]\ndiameter = \"2 mm\"\n[material]\npreset = \"zeolite_4ak\"\n[impact]\nspeed = \"20 m/s\"\n",
      "case.toml", overrides);
  return expected_card(config);
}

TEST(RunSanity, AnElasticRunIsExpectedToEndTenCrossingsAfterItsContact) {
  const SanityCard elastic = card({"fracture.insertion=none", "impact.speed=5m/s"});
  const double approach = initial_gap(elastic.input.contact_element_size) / 5.0;
  EXPECT_DOUBLE_EQ(elastic.end_time, approach + elastic.contact_time + 10.5 * elastic.crossing_time);
  EXPECT_DOUBLE_EQ(run_limits(elastic).quiet_time, 10.0 * elastic.crossing_time);
  EXPECT_LT(elastic.end_time, run_limits(elastic).end_time);
}

TEST(RunSanity, ARunThatBreaksIsExpectedToTakeAllItMay) {
  const SanityCard breaking = card({});
  const double approach = initial_gap(breaking.input.contact_element_size) / 20.0;
  EXPECT_DOUBLE_EQ(breaking.end_time, approach + 50.0 * breaking.crossing_time);
  EXPECT_DOUBLE_EQ(run_limits(breaking).end_time, breaking.end_time);
}

// At slow and at grazing impacts the way to the wall and the contact take longer than 50 crossings: they and the quiet
// time after them fit into every run.
TEST(RunSanity, NoImpactIsCutOffInMidContact) {
  for (const char* angle : {"0.001 deg", "1 deg", "90 deg"})
    for (const char* speed : {"1mm/s", "2mm/s", "1cm/s", "1m/s", "100m/s"}) {
      const SanityCard slow = card({std::string("impact.speed=") + speed, std::string("impact.angle=") + angle});
      const double approach = initial_gap(slow.input.contact_element_size) / slow.normal_speed;
      EXPECT_TRUE(run_limits(slow).automatic);
      EXPECT_GE(run_limits(slow).end_time, approach + slow.contact_time + 15.0 * slow.crossing_time) << speed;
    }
  const SanityCard slow = card({"impact.speed=1mm/s", "impact.angle=0.001 deg"});
  EXPECT_GT(slow.contact_time, 50.0 * slow.crossing_time);
}

TEST(RunSanity, AGivenEndTimeIsKept) {
  const SanityCard given = card({"run.end_time=3us"});
  EXPECT_DOUBLE_EQ(given.end_time, 3e-6);
  EXPECT_FALSE(run_limits(given).automatic);
  EXPECT_DOUBLE_EQ(run_limits(given).end_time, 3e-6);
}

// The finer mesh has the lower ratio, and the run takes it.
TEST(RunSanity, CrushedZoneFacetsSetTheModeIiRatioByTheMesh) {
  const auto ratio = [](const std::string& size, const std::string& facets) {
    const std::vector<std::string> overrides{"mesh.contact_element_size=" + size,
                                             "fracture.crushed_zone_facets=" + facets};
    const RunConfig config = config_from_text(
        "[particle]\ndiameter = \"2 mm\"\n[mesh]\nelement_size = \"0.2 mm\"\ncontact_extent = \"0.3 mm\"\n[material]\n"
        "preset = \"zeolite_4ak\"\n[fracture]\nallow_unresolved = true\n[impact]\nspeed = \"20 m/s\"\n",
        "case.toml", overrides);
    RunLog log(true);
    const PreparedRun run = prepare_run(config, "case", log);
    EXPECT_EQ(run.simulation.reference.laws.front().kappa, run.identity.card.fracture->mode_ii_ratio);
    return run.simulation.reference.laws.front().kappa;
  };
  EXPECT_EQ(ratio("0.1 mm", "0"), 1.0);
  const double coarse = ratio("0.1 mm", "2"), fine = ratio("0.06 mm", "2");
  EXPECT_GT(coarse, 1.05);
  EXPECT_LT(fine, 0.95 * coarse);
}

SanityCard card_of_tool(const std::string& motion) {
  const RunConfig config = config_from_text(
      "[particle]\ndiameter = \"2 mm\"\n[material]\npreset = \"zeolite_4ak\"\n[impact]\nwall = true\n"
      "[[tool]]\ntype = \"platen\"\nradius = 0.003\nnormal = [0, 0, -1]\nvelocity = [0, 0, -0.5]\n" +
          motion,
      "case.toml");
  return expected_card(config);
}

// A tool that goes on loads the particle until it breaks, however slow it is: the contact grows to what an impact at
// the critical speed has, and the run lasts until a quarter of the diameter is pressed.
TEST(RunSanity, AToolThatPressesIsNoSlowImpact) {
  for (const char* motion : {"motion = \"velocity\"\n", "motion = \"free\"\nmass = \"1 g\"\n"}) {
    const SanityCard pressed = card_of_tool(motion);
    const double critical = pressed.fracture->critical_speed;
    const SanityCard impact = card({fmt::format("impact.speed={}", critical)});
    EXPECT_NEAR(pressed.contact_radius.length, impact.contact_radius.length, 1e-6 * impact.contact_radius.length);
    EXPECT_NEAR(pressed.peak_force, 8.34e6 * 4e-6 / 0.9, 1e-6 * pressed.peak_force);
    EXPECT_GT(pressed.end_time, 0.25 * 2e-3 / 0.5);
    EXPECT_LT(pressed.end_time, 0.26 * 2e-3 / 0.5);
  }
  const SanityCard light = card_of_tool("motion = \"free\"\nmass = \"1 mg\"\n");
  EXPECT_LT(light.contact_radius.length, card({"impact.speed=1m/s"}).contact_radius.length);
}

}  // namespace
}  // namespace knap
