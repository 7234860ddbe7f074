#include <gmock/gmock.h>

#include "io/csv_table.hpp"
#include "tests/app/program.hpp"

namespace knap {
namespace {

using testing::HasSubstr;

constexpr const char* threefold = R"(
[particle]
diameter = "2 mm"
[mesh]
element_size = "0.3 mm"
[material]
preset = "zeolite_4ak"
[fracture]
allow_unresolved = true
[impact]
speed = "18 m/s"
repeat = 3
[run]
end_time = "20 us"
[output]
frames = 2
picture = false
checkpoint_interval = 0.02
)";

class RepeatedImpact : public ProgramTest {
 protected:
  RepeatedImpact() { write("case.toml", threefold); }
  std::vector<std::string> command(const std::string& out) const {
    return {"run", "case.toml", "--quiet", "--threads", "1", "--out", out};
  }
  CsvColumns impacts(const std::string& out) const { return read_csv(folder / out / "impacts.csv"); }
};

TEST_F(RepeatedImpact, ThrowsTheLargestPieceAgainWithItsDamage) {
  const Ended ended = run(command("out"));
  ASSERT_EQ(ended.code, 0) << ended.err;
  const CsvColumns rows = impacts("out");
  const auto& before = rows.column("mass_before [kg]");
  const auto& after = rows.column("mass_after [kg]");
  const auto& energy = rows.column("incident_energy [J]");
  ASSERT_EQ(before.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LE(after[i], before[i] * (1.0 + 1e-12));
    EXPECT_NEAR(energy[i], 0.5 * before[i] * 18.0 * 18.0, 1e-9 * energy[i]);
    const double thrown = i == 0 ? before[0] : after[i - 1];
    EXPECT_NEAR(before[i], thrown, 1e-6 * before[0]);  // mass scaling adds less
    EXPECT_LT(rows.column("closure_error [-]")[i], 0.01);
  }
  EXPECT_LT(after[2], before[0]);
  for (const std::string impact : {"impact_1", "impact_2", "impact_3"}) {
    EXPECT_EQ(report("out/" + impact)["status"], "finished");
    EXPECT_TRUE(std::filesystem::exists(folder / "out" / impact / "frames.pvd"));
  }
  // Cracks of the first impact are there when the second begins, those in the piece.
  const double old_area = report("out/impact_1")["cracks"]["area"];
  const double inherited =
      report("out/impact_2")["cracks"]["area"].get<double>() - rows.column("new_cracked_area [m2]")[1];
  EXPECT_GT(inherited, 0.1 * old_area);
  EXPECT_LE(inherited, old_area);
}

TEST_F(RepeatedImpact, KilledInTheSecondEndsAsIfNeverKilled) {
  ASSERT_EQ(run(command("whole")).code, 0);
  const Started started = start(command("killed"));
  ASSERT_TRUE(wait_for(folder / "killed/impact_2/checkpoint.h5", started));
  ::kill(started.pid, SIGKILL);
  wait(started);
  auto again = command("killed");
  again.push_back("--resume");
  const Ended ended = run(again);
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(content(folder / "whole/impacts.csv"), content(folder / "killed/impacts.csv"));
  EXPECT_EQ(report("whole/impact_3")["state_hash"], report("killed/impact_3")["state_hash"]);
  EXPECT_EQ(content(folder / "whole/impact_2/history.csv"), content(folder / "killed/impact_2/history.csv"));
}

TEST_F(RepeatedImpact, OverwriteLeavesNothingOfTheOldImpacts) {
  ASSERT_EQ(run(command("out")).code, 0);
  auto single = command("out");
  single.insert(single.end(), {"--overwrite", "--set", "impact.repeat=1", "--set", "run.end_time=1us"});
  ASSERT_EQ(run(single).code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder / "out/impact_1"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out/impacts.csv"));
  EXPECT_TRUE(std::filesystem::exists(folder / "out/report.json"));
}

TEST_F(RepeatedImpact, IsRefusedWithoutTheWall) {
  write("tool.toml", std::string(threefold) + "[[tool]]\ntype = \"sphere\"\nradius = \"1 mm\"\n");
  const Ended ended = run({"check", "tool.toml"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("impact.repeat = 3: throws the particle onto the wall"));
  EXPECT_THAT(run({"check", "case.toml", "--set", "impact.repeat=0"}).err, HasSubstr("impact.repeat"));
}

}  // namespace
}  // namespace knap
