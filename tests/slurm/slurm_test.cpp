// Campaigns through a real Slurm on this machine.
#include <gmock/gmock.h>

#include <algorithm>
#include <optional>

#include "tests/app/campaign_runs.hpp"
#include "tests/slurm/cluster.hpp"

namespace knap {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr const char* six = "[1, 2, 3, 4, 5, 6]";  // more than an array takes here

class SlurmCampaigns : public CampaignRuns {
 protected:
  void SetUp() override {
    if (const std::string obstacle = Cluster::obstacle(); !obstacle.empty()) GTEST_SKIP() << obstacle;
    cluster.emplace(folder / "cluster");
    ASSERT_TRUE(cluster->is_up()) << content(folder / "cluster/slurmctld.log");
    write("study.campaign.toml", seeds(six, "6 us"));
  }

  Started start_slurm(std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"campaign", "study.campaign.toml", "--out", "c", "--engine", "slurm"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return start(arguments);
  }
  Ended run_slurm(const std::vector<std::string>& more = {}) const { return wait(start_slurm(more)); }

  std::size_t num_submitted_tasks() const {
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator(folder / "c/slurm"))
      if (entry.path().extension() == ".tasks") {
        const std::string table = content(entry.path());
        count += static_cast<std::size_t>(std::count(table.begin(), table.end(), '\n'));
      }
    return count;
  }
  std::size_t num_arrays() const {
    const auto is_job = [](const auto& entry) { return entry.path().extension() == ".job"; };
    return static_cast<std::size_t>(std::count_if(fs::directory_iterator(folder / "c/slurm"), {}, is_job));
  }

  std::optional<Cluster> cluster;
};

TEST_F(SlurmCampaigns, GiveTheSameResultsInSeveralArrays) {
  const Ended ended = run_slurm();
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("6 runs done (0 of them before), 0 failed"));
  EXPECT_EQ(num_arrays(), 2u);
  EXPECT_EQ(num_submitted_tasks(), 6u);
  EXPECT_FALSE(fs::exists(folder / "c/slurm/batch_0001"));  // closed
  expect_results_of_undisturbed_runs();
}

TEST_F(SlurmCampaigns, LoseNothingWithANode) {
  write("study.campaign.toml", seeds(six, "20 us"));
  const Started started = start_slurm();
  ASSERT_TRUE(wait_for(folder / "c/runs/seed_1/effective.toml", started));
  ASSERT_EQ(Cluster::call("squeue --noheader --nodelist=n1 --states=running | grep ."), 0);
  cluster->kill_node("n1");
  const Ended ended = wait(started);
  ASSERT_EQ(ended.code, 0) << ended.out << ended.err;
  EXPECT_GT(num_submitted_tasks(), 6u);
  expect_results_of_undisturbed_runs();
}

TEST_F(SlurmCampaigns, TryAKilledRunAgain) {
  write("study.campaign.toml", seeds(six, "20 us"));
  const Started started = start_slurm();
  ASSERT_TRUE(wait_for(folder / "c/runs/seed_2/effective.toml", started));
  ASSERT_TRUE(kill_run("seed_2"));
  const Ended ended = wait(started);
  ASSERT_EQ(ended.code, 0) << ended.out << ended.err;
  EXPECT_EQ(num_submitted_tasks(), 7u);
  expect_results_of_undisturbed_runs();
}

TEST_F(SlurmCampaigns, TakeOverTheJobsOfAKilledOne) {
  write("study.campaign.toml", seeds(six, "20 us"));
  const Started started = start_slurm();
  ASSERT_TRUE(wait_for(folder / "c/runs/seed_1/effective.toml", started));
  ::kill(started.pid, SIGKILL);
  EXPECT_EQ(wait(started).code, 128 + SIGKILL);
  fs::remove(folder / "c/slurm/batch_0001.job");        // as if it had been killed before it could note the number
  fs::create_directory(folder / "c/slurm/batch_0003");  // and before it could submit this one
  write("c/slurm/batch_0003.sh", "#SBATCH --job-name=never_seen\n");
  write("c/slurm/batch_0003.tasks", "seed_6 log command\n");
  const Ended local = run_campaign();
  EXPECT_EQ(local.code, 2);
  EXPECT_THAT(local.err, HasSubstr("may still run under Slurm"));
  const Ended ended = run_slurm();
  ASSERT_EQ(ended.code, 0) << ended.out << ended.err;
  EXPECT_EQ(num_submitted_tasks(), 6u);
  expect_results_of_undisturbed_runs();
}

TEST_F(SlurmCampaigns, StopTheirJobsWhenInterruptedAndGoOn) {
  write("study.campaign.toml", seeds(six, "20 us"));
  const Started started = start_slurm({"--jobs", "1"});
  ASSERT_TRUE(wait_for(folder / "c/runs/seed_1/history.csv", started));
  ::kill(started.pid, SIGINT);
  const Ended interrupted = wait(started);
  EXPECT_EQ(interrupted.code, 130);
  EXPECT_THAT(interrupted.err, HasSubstr("the same command goes on with it"));
  EXPECT_NE(Cluster::call("squeue --noheader --states=pending,running | grep ."), 0);
  EXPECT_TRUE(fs::exists(folder / "c/runs/seed_1/checkpoint.h5"));
  EXPECT_THAT(content(folder / "c/slurm/batch_0001.sh"), HasSubstr("--array=0-4%1\n"));
  EXPECT_EQ(run_campaign({"--jobs", "2"}).code, 0);  // nothing is left under Slurm
  expect_results_of_undisturbed_runs();
}

TEST_F(SlurmCampaigns, OutliveTheController) {
  write("study.campaign.toml", seeds(six, "20 us"));
  const Started started = start_slurm();
  ASSERT_TRUE(wait_for(folder / "c/runs/seed_1/effective.toml", started));
  cluster->pause_controller();
  ASSERT_TRUE(wait_for(folder / "c/runs/seed_1/report.json", started));
  for (int i = 0; i < 1200 && content(started.out).find("does not answer") == std::string::npos; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_THAT(content(started.out), HasSubstr("Slurm does not answer, asking again"));
  cluster->revive_controller();
  const Ended ended = wait(started);
  ASSERT_EQ(ended.code, 0) << ended.out << ended.err;
  EXPECT_EQ(num_submitted_tasks(), 6u);
  expect_results_of_undisturbed_runs();
}

TEST_F(SlurmCampaigns, TellWhySlurmRefuses) {
  const Ended refused = run_slurm({"--slurm-options", "--partition=nowhere"});
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, HasSubstr("sbatch: error: "));
  EXPECT_THAT(refused.err, HasSubstr("invalid partition"));
  const Ended ended = run_slurm({"--slurm-options", "--partition=test --comment='two words'"});
  EXPECT_EQ(ended.code, 0) << ended.err;
}

// Limits are of the accounting, which needs a data base: a stand-in for sbatch refuses as the real one does.
TEST_F(SlurmCampaigns, SubmitInPiecesUnderALimit) {
  write("sbatch", R"sh(#!/bin/bash
tasks=$(sed -n 's/^#SBATCH --array=0-\([0-9]*\).*/\1/p' "${@: -1}")
queued=$(squeue --noheader --array --states=pending,running | wc -l)
if ((tasks + 1 + queued > 3)); then
  echo "sbatch: error: AssocMaxSubmitJobLimit" >&2
  echo "sbatch: error: Batch job submission failed: Job violates accounting/QOS policy (job submit limit)" >&2
  exit 1
fi
PATH=${PATH#*:} exec sbatch "$@"
)sh");
  fs::permissions(folder / "sbatch", fs::perms::owner_all);
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", (folder.string() + ":" + path).c_str(), 1);
  const Ended ended = run_slurm();
  ::setenv("PATH", path.c_str(), 1);
  ASSERT_EQ(ended.code, 0) << ended.out << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("AssocMaxSubmitJobLimit"));
  EXPECT_EQ(num_submitted_tasks(), 6u);
  EXPECT_GT(num_arrays(), 2u);
}

using NoSlurm = CampaignRuns;

TEST_F(NoSlurm, IsTold) {
  ::setenv("PATH", "/nowhere", 1);
  const Ended ended = run_campaign({"--engine", "slurm"});
  EXPECT_EQ(ended.code, 1);
  EXPECT_THAT(ended.err, HasSubstr("error: scontrol: there is no such program in PATH"));
  EXPECT_THAT(run_campaign({"--slurm-options", "--mem=2G"}).err, HasSubstr("needs --engine slurm"));
}

}  // namespace
}  // namespace knap
