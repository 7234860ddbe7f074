// Campaigns as a user runs them.
#include <gmock/gmock.h>

#include "tests/app/campaign_runs.hpp"

namespace knap {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST_F(CampaignRuns, RunsEverythingOnceAndMakesOneTable) {
  const Ended first = run_campaign();
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_THAT(first.out, HasSubstr("4 runs done (0 of them before), 0 failed"));
  const auto rows = results();
  ASSERT_EQ(rows.size(), 4u);
  const auto& row = rows.at("speed_25mps-seed_2");
  EXPECT_EQ(row.at("impact.speed [m/s]"), "25");
  EXPECT_EQ(row.at("run.seed"), "2");
  EXPECT_EQ(row.at("state"), "done");
  const auto report = nlohmann::json::parse(content(folder / "c/runs/speed_25mps-seed_2/report.json"));
  EXPECT_EQ(std::stod(row.at("breakage.chipping_ratio")), report["breakage"]["chipping_ratio"].get<double>());
  EXPECT_EQ(std::stod(row.at("tools.wall.max_force")), report["tools"][0]["max_force"].get<double>());
  const auto written = fs::last_write_time(folder / "c/runs/speed_25mps-seed_2/report.json");
  const Ended second = run_campaign();
  EXPECT_EQ(second.code, 0);
  EXPECT_THAT(second.out, HasSubstr("4 runs done (4 of them before)"));
  EXPECT_EQ(fs::last_write_time(folder / "c/runs/speed_25mps-seed_2/report.json"), written);
}

TEST_F(CampaignRuns, RefusesRepeatsThatWouldBeTheSameRun) {
  std::string text = breaking_case;
  text.insert(text.find("[mesh]\n") + 7, "seed = 3\n");
  write("case.toml", text);
  const Ended ended = run_campaign();
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, AllOf(HasSubstr("the same run as speed_15mps-seed_1: run.seed changes nothing"),
                               HasSubstr("(run speed_15mps-seed_2)")));
  EXPECT_FALSE(fs::exists(folder / "c"));
}

TEST_F(CampaignRuns, AKilledOneGoesOnAndComesToTheSameResults) {
  ASSERT_EQ(run({"campaign", "study.campaign.toml", "--out", "whole"}).code, 0);
  const Started started = start({"campaign", "study.campaign.toml", "--out", "c", "--jobs", "1"});
  ASSERT_TRUE(wait_for(folder / "c/runs/speed_15mps-seed_1/report.json", started));
  ::kill(started.pid, SIGKILL);
  EXPECT_EQ(wait(started).code, 128 + SIGKILL);
  const Ended again = run_campaign();
  ASSERT_EQ(again.code, 0) << again.err;
  const auto rows = results(), expected = results("whole");
  ASSERT_EQ(rows.size(), 4u);
  for (const auto& [name, row] : expected) EXPECT_EQ(rows.at(name).at("state_hash"), row.at("state_hash")) << name;
}

TEST_F(CampaignRuns, AnInterruptedOneStopsItsRuns) {
  write("study.campaign.toml",
        campaign("[\"25 m/s\"]", "\"mesh.element_size\" = \"0.1 mm\"\n\"mesh.contact_element_size\" = \"0.1 mm\"\n"));
  const Started started = start({"campaign", "study.campaign.toml", "--out", "c", "--jobs", "2"});
  ASSERT_TRUE(wait_for(folder / "c/runs/speed_25mps-seed_1/effective.toml", started));
  ::kill(started.pid, SIGINT);
  const Ended ended = wait(started);
  EXPECT_EQ(ended.code, 130);
  EXPECT_THAT(ended.err, HasSubstr("the same command goes on with it"));
}

TEST_F(CampaignRuns, AFailedRunIsRecordedAndTheRestGoOn) {
  write("study.campaign.toml",
        "[campaign]\nbase = \"case.toml\"\n[set]\n\"output.frames\" = 0\n"
        "[[axis]]\nkey = \"run.end_time\"\nvalues = [\"1 ns\", \"2 us\"]\n");
  const Ended first = run_campaign();
  EXPECT_EQ(first.code, 1);
  EXPECT_THAT(first.err, HasSubstr("error: end_time_1ns: run.end_time = 1e-09 s: is shorter than one time step"));
  const auto rows = results();
  EXPECT_EQ(rows.at("end_time_1ns").at("state"), "failed");
  EXPECT_THAT(rows.at("end_time_1ns").at("reason"), HasSubstr("shorter than one time step"));
  EXPECT_EQ(rows.at("end_time_1ns").at("breakage.chipping_ratio"), "");
  EXPECT_EQ(rows.at("end_time_2us").at("state"), "done");
  const auto log = folder / "c/logs/end_time_1ns.txt";
  const auto written = fs::last_write_time(log);
  EXPECT_EQ(run_campaign().code, 1);  // it is not tried again ...
  EXPECT_EQ(fs::last_write_time(log), written);
  EXPECT_EQ(run_campaign({"--retry"}).code, 1);  // ... unless asked for
  EXPECT_NE(fs::last_write_time(log), written);
}

TEST_F(CampaignRuns, TwoOnOneFolderAreRefused) {
  const Started started = start({"campaign", "study.campaign.toml", "--out", "c", "--jobs", "1"});
  ASSERT_TRUE(wait_for(folder / "c/results.csv", started));
  const Ended second = run_campaign();
  EXPECT_EQ(second.code, 2);
  EXPECT_THAT(second.err, HasSubstr("another campaign writes here"));
  EXPECT_EQ(wait(started).code, 0);
  EXPECT_EQ(results().size(), 4u);
}

TEST_F(CampaignRuns, MistakesStopItBeforeTheFirstRun) {
  write("study.campaign.toml", campaign("[\"15 m/s\", \"15 kg\", \"-15 m/s\"]", "\"impact.wall_frction\" = 0.1\n"));
  const Ended ended = run_campaign();
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err,
              HasSubstr("error: study.campaign.toml:6:25: [impact] has no key \"wall_frction\" (did you mean "
                        "\"wall_friction\"?) (run speed_15mps-seed_1 and 5 more)\n"));
  EXPECT_THAT(ended.err, HasSubstr("error: study.campaign.toml:9:10: impact.speed = \"15 kg\": "));
  EXPECT_THAT(ended.err, HasSubstr("(run speed_15kg-seed_1 and 1 more)\n"));
  EXPECT_THAT(ended.err, HasSubstr("error: study.campaign.toml:9:10: impact.speed = \"-15 m/s\": "));
  EXPECT_FALSE(fs::exists(folder / "c"));
}

TEST_F(CampaignRuns, ThePlanRefusesWhatARunWould) {
  write("study.campaign.toml", campaign("[\"15 m/s\"]", "\"fracture.allow_unresolved\" = false\n"));
  const Ended run_alone = run({"run", "case.toml", "--set", "fracture.allow_unresolved=false"});
  EXPECT_EQ(run_alone.code, 2);
  EXPECT_THAT(run_alone.err, HasSubstr("the cohesive zone of"));
  for (const Ended& ended : {run({"campaign", "plan", "study.campaign.toml"}), run_campaign()}) {
    EXPECT_EQ(ended.code, 2);
    EXPECT_THAT(ended.err, AllOf(HasSubstr("the cohesive zone of"), HasSubstr("(run speed_15mps-seed_1 and 1 more)")));
  }
}

TEST_F(CampaignRuns, RunsItHasNoMoreAreTold) {
  ASSERT_EQ(run_campaign().code, 0);
  write("study.campaign.toml", campaign("[\"25 m/s\"]"));
  const Ended ended = run_campaign();
  EXPECT_EQ(ended.code, 0);
  EXPECT_THAT(ended.out, HasSubstr("results of 2 runs lie in c/runs that the campaign has no more, such as "
                                   "speed_15mps-seed_1; they are left out of results.csv"));
  EXPECT_EQ(results().size(), 2u);
}

TEST_F(CampaignRuns, ChangedCasesAndForeignFoldersAreLeftAlone) {
  write("study.campaign.toml", campaign("[\"25 m/s\"]"));
  ASSERT_EQ(run_campaign().code, 0);
  const std::string before = content(folder / "c/results.csv");
  write("study.campaign.toml", campaign("[\"25 m/s\"]", "\"impact.wall_friction\" = 0.2\n"));
  const Ended changed = run_campaign();
  EXPECT_EQ(changed.code, 2);
  EXPECT_THAT(changed.err, HasSubstr("was run with another case"));
  EXPECT_EQ(content(folder / "c/results.csv"), before);
  fs::create_directory(folder / "mine");
  write("mine/thesis.txt", "all of it");
  EXPECT_THAT(run({"campaign", "study.campaign.toml", "--out", "mine"}).err, HasSubstr("holds no campaign"));
}

TEST_F(CampaignRuns, ThePlanShowsRunsTimeAndMemory) {
  const Ended plan = run({"campaign", "plan", "study.campaign.toml", "--jobs", "2"});
  EXPECT_EQ(plan.code, 0) << plan.err;
  EXPECT_THAT(plan.out, HasSubstr("speed_15mps-seed_1"));
  EXPECT_THAT(plan.out, HasSubstr("4 runs, 0 done"));
  EXPECT_FALSE(fs::exists(folder / "out"));
  EXPECT_THAT(run({"campaign", "plan", "study.campaign.toml", "--scale"}).err, HasSubstr("no run is done yet"));
  ASSERT_EQ(run_campaign().code, 0);
  const Ended scaled = run({"campaign", "plan", "study.campaign.toml", "--scale", "--out", "c"});
  EXPECT_THAT(scaled.out, HasSubstr("4 runs, 4 done"));
  EXPECT_THAT(scaled.out, HasSubstr("10,000 such runs: "));
}

}  // namespace
}  // namespace knap
