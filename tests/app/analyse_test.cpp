// The analysis of real campaigns, as a user runs it.
#include <gmock/gmock.h>

#include "io/csv_line.hpp"
#include "tests/app/program.hpp"

namespace knap {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Analyse : public ProgramTest {
 protected:
  Analyse() {
    write("case.toml", breaking_case);
    write("study.campaign.toml",
          "[campaign]\nbase = \"case.toml\"\n[set]\n\"output.frames\" = 1\n\"run.end_time\" = \"6 us\"\n"
          "[[axis]]\nkey = \"impact.speed\"\nvalues = [\"15 m/s\", \"30 m/s\"]\n"
          "[[axis]]\nkey = \"impact.angle\"\nvalues = [\"60 deg\", \"90 deg\"]\n");
  }
  nlohmann::json analysis(const std::string& out) const {
    return nlohmann::json::parse(content(folder / out / "analysis/analysis.json"));
  }
};

TEST_F(Analyse, IsMadeAtTheEndOfACampaignAndCanBeMadeAgain) {
  const Ended ended = run({"campaign", "study.campaign.toml", "--out", "c"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("4 runs analysed"));
  EXPECT_GT(fs::file_size(folder / "c/report.html"), 500000U);  // with its fragments and what turns them
  const auto first = analysis("c");
  EXPECT_EQ(first["runs"]["done"], 4);
  EXPECT_EQ(first["chipping"][0]["class_map"].size(), 4U);
  const std::string table = content(folder / "c/results.csv");
  const Ended again = run({"analyse", "c", "--out", "elsewhere", "--sieve", "1 mm", "--normal-speeds", "15 m/s,9"});
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_TRUE(fs::exists(folder / "elsewhere/report.html"));
  EXPECT_EQ(analysis("elsewhere")["sieve_m"], 1e-3);
  EXPECT_EQ(content(folder / "c/results.csv"), table);
  // Nothing was run, so nothing is analysed anew.
  const auto written = fs::last_write_time(folder / "c/report.html");
  EXPECT_EQ(run({"campaign", "study.campaign.toml", "--out", "c"}).code, 0);
  EXPECT_EQ(fs::last_write_time(folder / "c/report.html"), written);
}

TEST_F(Analyse, TakesRepeatedImpactsByTheirFirst) {
  write("study.campaign.toml",
        "[campaign]\nbase = \"case.toml\"\n[set]\n\"output.frames\" = 0\n\"run.end_time\" = \"6 "
        "us\"\n\"impact.repeat\" = 2\n"
        "[[axis]]\nkey = \"impact.speed\"\nvalues = [\"12 m/s\", \"30 m/s\"]\n");
  const Ended ended = run({"campaign", "study.campaign.toml", "--out", "c"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const auto whole = nlohmann::json::parse(content(folder / "c/runs/speed_12mps/report.json"));
  const auto first = nlohmann::json::parse(content(folder / "c/runs/speed_12mps/impact_1/report.json"));
  EXPECT_EQ(whole["impacts"]["count"], 2);
  EXPECT_LE(whole["impacts"]["mass_left"].get<double>(),
            1.0 - first["breakage"]["chipping_ratio"].get<double>() + 1e-9);
  EXPECT_EQ(whole["state_hash"], first["state_hash"]);
  EXPECT_THAT(content(folder / "c/results.csv"), HasSubstr("impacts.count"));
}

TEST_F(Analyse, SaysWhatIsWrong) {
  EXPECT_EQ(run({"analyse", "nowhere"}).code, 2);
  EXPECT_THAT(run({"analyse", "nowhere"}).err,
              HasSubstr("error: nowhere: holds no results.csv: give the folder of a campaign"));
  EXPECT_THAT(run({"analyse", ".", "--sieve", "1 kg"}).err, HasSubstr("--sieve \"1 kg\""));
  EXPECT_EQ(run({"analyse", ".", "--broken", "2"}).code, 2);
  EXPECT_THAT(run({"analyse", ".", "--normal-speeds", "8,x"}).err, HasSubstr("--normal-speeds \"x\": "));
  EXPECT_THAT(run({"analyse", ".", "--normal-speeds", "0"}).err, HasSubstr("must be above 0"));
  EXPECT_EQ(run({"analyse"}).code, 2);
}

}  // namespace
}  // namespace knap
