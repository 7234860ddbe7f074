// A small particle breaks: every file is there and says what it should.
#include <gmock/gmock.h>

#include "config/load_config.hpp"
#include "io/csv_table.hpp"
#include "tests/app/program.hpp"

namespace knap {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::Each;
using testing::HasSubstr;
using testing::Not;

class Run : public ProgramTest {
 protected:
  Run() { write("case.toml", breaking_case); }
};

// The keys that users' scripts rely on.
void expect_keys(const json& report) {
  for (const char* pointer : {"/status",
                              "/stop_reason",
                              "/version",
                              "/state_hash",
                              "/mesh/tets",
                              "/mesh/nodes",
                              "/mesh/quality_min",
                              "/mesh/edge_mean",
                              "/time/end",
                              "/time/steps",
                              "/time/dt",
                              "/energy/incident",
                              "/energy/closure_error",
                              "/energy/kinetic",
                              "/energy/strain",
                              "/energy/cohesive_stored",
                              "/energy/cohesive_dissipated",
                              "/energy/closure_impact",
                              "/energy/crack_friction",
                              "/energy/contact_dissipated",
                              "/energy/tool_friction",
                              "/energy/tool_impact",
                              "/energy/viscous",
                              "/energy/rigid_vibration",
                              "/energy/mass_scaling",
                              "/energy/tool_work",
                              "/momentum/linear_error",
                              "/momentum/angular_error",
                              "/breakage/chipping_ratio",
                              "/breakage/t10",
                              "/breakage/t10_resolved",
                              "/breakage/class",
                              "/rebound/restitution_normal",
                              "/rebound/restitution_tangential",
                              "/rebound/spin",
                              "/performance/wall_s",
                              "/performance/tet_updates_per_s",
                              "/performance/threads",
                              "/performance/phases",
                              "/tools/0/max_force",
                              "/sanity/critical_speed",
                              "/units"})
    EXPECT_TRUE(report.contains(json::json_pointer(pointer))) << pointer;
  for (const char* of : {"/fragments", "/fragments/by_damage_label"})
    for (const char* key : {"/count", "/count_above_1pct", "/count_above_0p1pct", "/largest_mass_fraction",
                            "/second_mass_fraction", "/unresolved_mass_fraction", "/mass_sum_fraction"})
      EXPECT_TRUE(report.contains(json::json_pointer(std::string(of) + key))) << of << key;
}

double sum_of_energies(const json& energy) {
  double sum = 0.0;
  for (const auto& [key, value] : energy.items())
    if (key != "incident" && key.rfind("closure_error", 0) != 0) sum += value.get<double>();
  return sum;
}

TEST_F(Run, WritesEveryFileAndAReportThatAddsUp) {
  const Ended ended = run({"run", "case.toml", "--out", "r", "--set", "output.picture=true"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  for (const char* file : {"report.json", "effective.toml", "history.csv", "fragments.csv", "size_distribution.csv",
                           "log.txt", "frames.pvd", "cracks.pvd", "frames/frame_0000.vtu", "cracks/cracks_0004.vtu"})
    EXPECT_TRUE(fs::exists(folder / "r" / file)) << file;
  // A machine where nothing can be drawn is no failure of the run.
  EXPECT_TRUE(fs::exists(folder / "r/picture.png") || ended.err.find("no picture") != std::string::npos);

  const json report = this->report("r");
  expect_keys(report);
  EXPECT_EQ(report["status"], "finished");
  EXPECT_EQ(report["stop_reason"], "end time");
  EXPECT_LE(report["energy"]["closure_error"], 0.01);
  EXPECT_NEAR(sum_of_energies(report["energy"]), 1.0, report["energy"]["closure_error"].get<double>() + 1e-12);
  EXPECT_NEAR(report["fragments"]["mass_sum_fraction"], 1.0, 1e-12);
  EXPECT_NEAR(report["fragments"]["by_damage_label"]["mass_sum_fraction"], 1.0, 1e-12);
  EXPECT_LE(report["momentum"]["linear_error"], 1e-12);
  EXPECT_LE(report["momentum"]["angular_error"], 1e-4);
  EXPECT_GT(report["fragments"]["count"], 3);
  EXPECT_NE(report["breakage"]["class"], "intact");
  EXPECT_TRUE(report["breakage"]["t10"].is_null());  // d/10 is below the element size here
  EXPECT_FALSE(report["breakage"]["t10_resolved"]);
}

TEST_F(Run, SummaryAndPlainProgressWhenPiped) {
  const Ended ended = run({"run", "case.toml", "--out", "r"});
  ASSERT_EQ(ended.code, 0);
  EXPECT_THAT(ended.err, AllOf(HasSubstr("Sanity card"), HasSubstr("steps/s"), HasSubstr("ledger")));
  EXPECT_THAT(ended.err + ended.out, AllOf(Not(HasSubstr("\r")), Not(HasSubstr("\x1b"))));
  EXPECT_THAT(ended.out, AllOf(HasSubstr("largest piece"), HasSubstr("chipping ratio"), HasSubstr("crack friction"),
                               HasSubstr("closure error"), HasSubstr("results")));
  EXPECT_THAT(content(folder / "r/log.txt"), AllOf(HasSubstr("Sanity card"), HasSubstr("chipping ratio")));
}

TEST_F(Run, EffectiveCaseRunsAgainToTheSameHash) {
  ASSERT_EQ(run({"run", "case.toml", "--quiet", "--out", "a", "--set", "impact.speed=22m/s"}).code, 0);
  ASSERT_EQ(run({"run", "a/effective.toml", "--quiet", "--out", "b"}).code, 0);
  EXPECT_EQ(report("a")["state_hash"], report("b")["state_hash"]);
  EXPECT_EQ(content(folder / "a/effective.toml"), content(folder / "b/effective.toml"));
}

TEST_F(Run, TablesAgreeWithTheReport) {
  ASSERT_EQ(run({"run", "case.toml", "--quiet", "--out", "r"}).code, 0);
  const json report = this->report("r");
  const CsvColumns history = read_csv(folder / "r/history.csv");
  EXPECT_NEAR(history.column("time [s]").back(), report["time"]["end"], 1e-15);
  EXPECT_DOUBLE_EQ(history.column("cracked_area [m2]").back(), report["cracks"]["area"]);
  EXPECT_EQ(history.column("fragments [-]").back(), report["fragments"]["count"]);
  EXPECT_DOUBLE_EQ(history.column("restitution [-]").back(), report["rebound"]["restitution_normal"]);
  EXPECT_DOUBLE_EQ(history.column("restitution [-]").front(), -1.0);
  EXPECT_THAT(history.column("closure_error [-]"), Each(testing::Le(0.01)));

  const CsvColumns fragments = read_csv(folder / "r/fragments.csv");
  EXPECT_EQ(fragments.column("id").size(), report["fragments"]["by_damage_label"]["count"]);
  const CsvColumns sizes = read_csv(folder / "r/size_distribution.csv");
  EXPECT_NEAR(sizes.column("finer_mass_fraction [-]").back(), 1.0, 1e-12);
}

TEST_F(Run, ElasticParticleStopsByItselfAfterItsRebound) {
  write("elastic.toml", elastic_case);
  const Ended ended = run({"run", "elastic.toml", "--quiet", "--out", "r"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const json report = this->report("r");
  EXPECT_EQ(report["stop_reason"], "at rest");
  EXPECT_EQ(report["breakage"]["class"], "intact");
  EXPECT_GT(report["rebound"]["restitution_normal"], 0.9);
  EXPECT_GT(report["rebound"]["spin"], 100.0);
  EXPECT_LT(report["rebound"]["restitution_tangential"], 0.99);
  EXPECT_FALSE(fs::exists(folder / "r/frames.pvd"));
}

TEST_F(Run, ASlowParticleReachesTheWall) {
  write("slow.toml", elastic_case);
  ASSERT_EQ(run({"run", "slow.toml", "--quiet", "--out", "s", "--set", "impact.angle=0.01 deg"}).code, 0);
  EXPECT_GT(report("s")["tools"][0]["max_force"].get<double>(), 0.0);
  const Ended early =
      run({"run", "slow.toml", "--quiet", "--out", "e", "--set", "impact.angle=0.01 deg", "--set", "run.end_time=1us"});
  EXPECT_THAT(early.err, HasSubstr("had not reached the wall"));
}

TEST_F(Run, TimesThatTheStepCannotMeetAreRefused) {
  write("times.toml", elastic_case);
  const auto refused = [&](std::vector<std::string> settings) {
    std::vector<std::string> arguments{"run", "times.toml", "--out", "t"};
    for (const std::string& setting : settings) arguments.insert(arguments.end(), {"--set", setting});
    const Ended ended = run(arguments);
    EXPECT_EQ(ended.code, 2);
    EXPECT_FALSE(std::filesystem::exists(folder / "t"));
    return ended.err;
  };
  EXPECT_THAT(refused({"run.end_time=1ps"}), HasSubstr("run.end_time = 1e-12 s: is shorter than one time step"));
  EXPECT_THAT(refused({"run.end_time=100s"}), HasSubstr("steps"));
  EXPECT_THAT(refused({"material.viscous_ratio=1", "material.relaxation_time=10ps"}),
              HasSubstr("material.relaxation_time = 1e-11 s: must be at least the time step"));
}

}  // namespace
}  // namespace knap
