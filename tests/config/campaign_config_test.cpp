#include "config/campaign_config.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "config/load_config.hpp"
#include "core/errors.hpp"

namespace knap {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string folder = KNAP_SOURCE_DIR "/cases/";

CampaignConfig campaign_of(const std::string& text) {
  return campaign_from_text("[campaign]\nbase = \"normal_impact.toml\"\n" + text, folder + "study.campaign.toml");
}

std::string complaint(const std::string& text) {
  try {
    campaign_of(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

constexpr auto speeds = "[[axis]]\nkey = \"impact.speed\"\nvalues = [\"8 m/s\", 14]\n";

TEST(Campaign, CombinesEveryValueWithEveryOther) {
  const CampaignConfig campaign =
      campaign_of(std::string("[set]\n\"output.frames\" = 0\n[set.mesh]\nseed = 4\n") + speeds +
                  "[[axis]]\nkeys = [\"mesh.element_size\", \"mesh.contact_element_size\"]\n"
                  "values = [[\"0.2 mm\", \"0.1 mm\"], [\"0.3 mm\", \"0.15 mm\"]]\n");
  EXPECT_EQ(campaign.base, folder + "normal_impact.toml");
  EXPECT_THAT(campaign_keys(campaign), ElementsAre("impact.speed", "mesh.element_size", "mesh.contact_element_size"));
  const auto runs = campaign_runs(campaign);
  ASSERT_EQ(runs.size(), 4u);
  EXPECT_EQ(runs[0].name, "speed_8mps-element_size_0.2mm-contact_element_size_0.1mm");
  std::vector<std::string> texts, lines;
  for (const Setting& setting : settings_of(campaign, runs[3])) {
    texts.push_back(setting.text);
    lines.push_back(setting.place.substr(setting.place.find(".toml:") + 6));
  }
  EXPECT_THAT(texts, ElementsAre("output.frames=0", "mesh.seed=4", "impact.speed=14", "mesh.element_size=0.3 mm",
                                 "mesh.contact_element_size=0.15 mm"));
  EXPECT_THAT(lines, ElementsAre("4:19", "6:8", "9:10", "12:10", "12:10"));
}

TEST(Campaign, RangesKeepTheirUnit) {
  const auto values = [](const std::string& range) {
    std::vector<std::string> texts;
    const CampaignConfig campaign = campaign_of("[[axis]]\nkey = \"impact.angle\"\n" + range);
    for (const auto& value : campaign.axes[0].values) texts.push_back(value[0]);
    return texts;
  };
  EXPECT_THAT(values("from = \"30 deg\"\nto = \"90 deg\"\ncount = 5\n"),
              ElementsAre("30 deg", "45 deg", "60 deg", "75 deg", "90 deg"));
  EXPECT_THAT(values("from = \"1 m/s\"\nto = \"100 m/s\"\ncount = 3\nspacing = \"log\"\n"),
              ElementsAre("1 m/s", "10 m/s", "100 m/s"));
  EXPECT_THAT(values("from = 3\nto = 7\ncount = 3\n"), ElementsAre("3", "5", "7"));
  EXPECT_THAT(values("from = 0.1\nto = 0.4\ncount = 2\n"), ElementsAre("0.1", "0.4"));
}

// One sample in each of n equal parts of every key's range.
TEST(Campaign, TheLatinHypercubeHasOneSampleInEveryStratum) {
  const CampaignConfig campaign = campaign_of(
      "[latin_hypercube]\nsamples = 20\nseed = 3\n[[sample]]\nkey = \"fracture.toughness\"\n"
      "from = \"0.1 MPa m^1/2\"\nto = \"0.3 MPa m^1/2\"\n[[sample]]\nkey = \"fracture.strength\"\nfrom = 1e6\nto = "
      "1e8\n"
      "spacing = \"log\"\n");
  const auto runs = campaign_runs(campaign);
  ASSERT_EQ(runs.size(), 20u);
  std::set<int> linear, logarithmic;
  std::set<std::string> names;
  for (const CampaignRun& run : runs) {
    const double toughness = std::get<double>(value_of("fracture.toughness", run.values[0]));
    const double strength = std::get<double>(value_of("fracture.strength", run.values[1]));
    linear.insert(static_cast<int>((toughness - 1e5) / 2e5 * 20.0));
    logarithmic.insert(static_cast<int>(std::log10(strength / 1e6) / 2.0 * 20.0));
    names.insert(run.name);
  }
  EXPECT_EQ(linear.size(), 20u);
  EXPECT_EQ(logarithmic.size(), 20u);
  EXPECT_EQ(names.size(), 20u);
  EXPECT_EQ(campaign_runs(campaign)[7].values, runs[7].values);
}

TEST(Campaign, ColumnsAreInSi) {
  EXPECT_EQ(column_of("impact.speed"), "impact.speed [m/s]");
  EXPECT_EQ(column_of("particle.upper.mesh.element_size"), "particle.upper.mesh.element_size [m]");
  EXPECT_EQ(column_of("run.seed"), "run.seed");
  EXPECT_DOUBLE_EQ(std::get<double>(value_of("impact.angle", "45 deg")), std::atan(1.0));
  EXPECT_EQ(std::get<std::int64_t>(value_of("run.seed", "7")), 7);
  EXPECT_THROW(value_of("impact.speed", "8 kg"), InputError);
}

TEST(Campaign, MistakesAreToldWithPlaceAndRemedy) {
  EXPECT_THAT(complaint(""), HasSubstr("nothing varies: add an [[axis]]"));
  EXPECT_THAT(complaint("[[axis]]\nkey = \"impact.speed\"\n"),
              HasSubstr("study.campaign.toml:3:1: axis.from is missing"));
  EXPECT_THAT(complaint("[[axis]]\nkey = \"impact.speed\"\nvalues = 3\n"), HasSubstr("must be an array of 1 to"));
  EXPECT_THAT(complaint("[[axis]]\nkey = \"speed\"\nvalues = [1]\n"), HasSubstr("must name keys of the case"));
  EXPECT_THAT(complaint("[[axis]]\nkey = \"a.b\"\nfrom = \"1 m\"\nto = \"2 mm\"\ncount = 2\n"),
              HasSubstr("must have the unit of from, \"m\""));
  EXPECT_THAT(complaint("[[axis]]\nkey = \"a.b\"\nfrom = 2\nto = 1\ncount = 2\n"), HasSubstr("must be above from"));
  EXPECT_THAT(complaint("[[axis]]\nkey = \"a.b\"\nfrom = 0\nto = 1\ncount = 2\nspacing = \"log\"\n"),
              HasSubstr("must be above 0"));
  EXPECT_THAT(complaint(std::string(speeds) + speeds), HasSubstr("impact.speed varies twice"));
  EXPECT_THAT(complaint("[[axis]]\nkey = \"a.b\"\nvalues = [1, 1]\n"), HasSubstr("a value is there twice"));
  EXPECT_THAT(complaint("[[axes]]\nkey = \"a.b\"\n"), HasSubstr("unknown section [[axes]] (did you mean \"axis\"?)"));
  EXPECT_THAT(complaint(std::string("[axis]\nkey = \"a.b\"\nvalues = [1]\n")), HasSubstr("write [[axis]]"));
  EXPECT_THAT(complaint(std::string(speeds) + "vales = [2]\n"), HasSubstr("has no key \"vales\" (did you mean"));
  EXPECT_THAT(complaint(std::string(speeds) + "[latin_hypercube]\nsamples = 3\n"), HasSubstr("needs a [[sample]]"));
  EXPECT_THROW(campaign_from_text("[[axis]]\nkey = \"a.b\"\nvalues = [1]\n", "c.toml"), InputError);
}

TEST(Campaign, AMissingBaseIsToldWithItsWholePath) {
  try {
    campaign_from_text(std::string("[campaign]\nbase = \"no.toml\"\n") + speeds, folder + "study.campaign.toml");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("study.campaign.toml:2:8: campaign.base = \"no.toml\": there is no case file " +
                                        folder + "no.toml"));
  }
}

TEST(Campaign, EveryRunOfEveryShippedOneLoads) {
  int runs = 0;
  for (const auto& file : std::filesystem::directory_iterator(KNAP_SOURCE_DIR "/cases")) {
    if (file.path().stem().extension() != ".campaign") continue;
    const CampaignConfig campaign = load_campaign(file.path());
    for (const CampaignRun& run : campaign_runs(campaign)) {
      EXPECT_NO_THROW(load_config(campaign.base, settings_of(campaign, run))) << file.path() << " " << run.name;
      ++runs;
    }
  }
  EXPECT_GE(runs, 8);
}

TEST(Campaign, TooManyRunsAreRefused) {
  std::string text;
  for (const char* key : {"a.b", "a.c", "a.d"})
    text += std::string("[[axis]]\nkey = \"") + key + "\"\nfrom = 0\nto = 99\ncount = 100\n";
  EXPECT_THAT(complaint(text), HasSubstr("1e+06 runs, allowed are 100000"));
}

}  // namespace
}  // namespace knap
