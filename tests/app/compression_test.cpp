// A small particle between a wall and a platen, through the program: curve, strength, statistics over seeds.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "io/csv_table.hpp"
#include "tests/app/program.hpp"
#include "tests/support/pressed_case.hpp"

namespace knap {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class CompressionRun : public ProgramTest {
 protected:
  CompressionRun() { write("case.toml", coarse_pressed_case()); }
};

TEST_F(CompressionRun, EndsAtTheDropAndTellsTheStrength) {
  const Ended ended = run({"run", "case.toml", "--out", "r", "--quiet"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const auto found = report("r");
  EXPECT_EQ(found["stop_reason"], "force dropped");
  EXPECT_EQ(found["tools"][0]["name"], "wall");
  EXPECT_EQ(found["tools"][1]["name"], "upper");
  EXPECT_NEAR(found["tools"][1]["displacement"][2].get<double>(), -8.0 * found["time"]["end"].get<double>(), 1e-9);
  const auto& c = found["compression"];
  EXPECT_EQ(c["tool"], "upper");
  EXPECT_TRUE(c["has_dropped"].get<bool>());
  const double d = found["sanity"]["diameter"];
  EXPECT_NEAR(c["strength"].get<double>(), 0.9 * c["fracture_force"].get<double>() / (d * d), 1.0);
  EXPECT_LT(c["fracture_force"].get<double>(), found["tools"][1]["max_force"].get<double>());

  const CsvColumns curve = read_csv(folder / "r/force_displacement.csv");
  const auto& force = curve.column("force [N]");
  const auto top = std::max_element(force.begin(), force.end());
  EXPECT_DOUBLE_EQ(*top, c["fracture_force"].get<double>());
  EXPECT_DOUBLE_EQ(curve.column("displacement [m]")[static_cast<std::size_t>(top - force.begin())],
                   c["displacement"].get<double>());
  const CsvColumns history = read_csv(folder / "r/history.csv");
  EXPECT_DOUBLE_EQ(history.column("upper_impulse_z [N s]").back(), -curve.column("impulse [N s]").back());
  EXPECT_TRUE(fs::exists(folder / "r/tools.pvd"));
  EXPECT_TRUE(fs::exists(folder / "r/tools/tools_0001.vtu"));
  EXPECT_FALSE(fs::exists(folder / "r/force_displacement.png"));
}

TEST_F(CompressionRun, OverwritingRemovesTheCurve) {
  ASSERT_EQ(run({"run", "case.toml", "--out", "r", "--quiet", "--set", "run.end_time=1us"}).code, 0);
  EXPECT_TRUE(fs::exists(folder / "r/force_displacement.csv"));
  write("other.toml", elastic_case);
  ASSERT_EQ(run({"run", "other.toml", "--out", "r", "--quiet", "--overwrite", "--set", "run.end_time=1us"}).code, 0);
  EXPECT_FALSE(fs::exists(folder / "r/force_displacement.csv"));
  EXPECT_FALSE(fs::exists(folder / "r/tools/tools_0002.vtu"));
}

TEST_F(CompressionRun, StrengthOverSeedsIsResumable) {
  const Ended two = run({"strength", "case.toml", "--seeds", "2", "--out", "s", "--set", "output.picture=false"});
  ASSERT_EQ(two.code, 0) << two.err;
  EXPECT_THAT(two.out, HasSubstr("Weibull modulus"));
  const auto written = fs::last_write_time(folder / "s/seed_0001/report.json");
  const Ended three = run({"strength", "case.toml", "--seeds", "3", "--out", "s", "--set", "output.picture=false"});
  ASSERT_EQ(three.code, 0) << three.err;
  EXPECT_EQ(fs::last_write_time(folder / "s/seed_0001/report.json"), written);

  const CsvColumns table = read_csv(folder / "s/strength.csv");
  EXPECT_THAT(table.column("seed"), testing::ElementsAre(1, 2, 3));
  for (std::size_t i = 0; i < 3; ++i) {
    const auto own = report("s/seed_000" + std::to_string(i + 1));
    EXPECT_DOUBLE_EQ(table.column("strength [Pa]")[i], own["compression"]["strength"].get<double>());
  }
  auto ranks = table.column("rank_probability [-]");
  std::sort(ranks.begin(), ranks.end());
  EXPECT_NEAR(ranks[1], 0.5, 1e-12);
  const auto fit = nlohmann::json::parse(content(folder / "s/strength.json"));
  EXPECT_EQ(fit["seeds"], 3);
  EXPECT_GT(fit["weibull_modulus"].get<double>(), 0.0);
  const double median =
      fit["weibull_scale"].get<double>() * std::pow(std::log(2.0), 1.0 / fit["weibull_modulus"].get<double>());
  EXPECT_NEAR(fit["median"].get<double>(), median, 1e-9 * median);

  const Ended other = run({"strength", "case.toml", "--seeds", "2", "--out", "s", "--set", "tool.upper.friction=0.5"});
  EXPECT_EQ(other.code, 2);
  EXPECT_THAT(other.err, HasSubstr("is of another case"));
}

TEST_F(CompressionRun, StrengthRefusesCasesThatHaveNone) {
  write("impact.toml", breaking_case);
  const Ended impact = run({"strength", "impact.toml", "--seeds", "2"});
  EXPECT_EQ(impact.code, 2);
  EXPECT_THAT(impact.err, HasSubstr("needs a [[tool]] that presses"));
  const Ended same =
      run({"strength", "case.toml", "--seeds", "2", "--set", "mesh.seed=1", "--set", "fracture.weibull_seed=1"});
  EXPECT_EQ(same.code, 2);
  EXPECT_THAT(same.err, HasSubstr("every seed would be the same run"));
}

}  // namespace
}  // namespace knap
