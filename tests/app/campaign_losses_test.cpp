// What a campaign loses when its runs are killed or its disk is full: nothing.
#include <gmock/gmock.h>
#include <sys/mount.h>

#include <cstdlib>

#include "tests/app/campaign_runs.hpp"

namespace knap {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class KilledRuns : public CampaignRuns {
 protected:
  KilledRuns() { write("study.campaign.toml", seeds("[1, 2, 3]", "6 us")); }
};

TEST_F(KilledRuns, AreTriedAgain) {
  const Started started = start({"campaign", "study.campaign.toml", "--out", "c", "--jobs", "2"});
  ASSERT_TRUE(kill_run("seed_2"));
  ASSERT_TRUE(kill_run("seed_3"));
  const Ended ended = wait(started);
  ASSERT_EQ(ended.code, 0) << ended.err;
  expect_results_of_undisturbed_runs();
}

TEST_F(KilledRuns, GoOnFromTheirCheckpoint) {
  write("study.campaign.toml",
        "[campaign]\nbase = \"case.toml\"\n[set]\n\"output.frames\" = 0\n\"output.checkpoint_interval\" = 0.01\n"
        "[[axis]]\nkey = \"run.end_time\"\nvalues = [\"40 us\"]\n");
  const Started started = start({"campaign", "study.campaign.toml", "--out", "c"});
  ASSERT_TRUE(wait_for(folder / "c/runs/end_time_40us/checkpoint.h5", started));
  ASSERT_TRUE(kill_run("end_time_40us"));
  ASSERT_EQ(wait(started).code, 0);
  EXPECT_THAT(content(folder / "c/runs/end_time_40us/log.txt"), HasSubstr("Resuming at step"));
  expect_results_of_undisturbed_runs();
}

TEST_F(KilledRuns, OfRepeatedImpactsKeepTheImpactsThatHadEnded) {
  write("study.campaign.toml",
        "[campaign]\nbase = \"case.toml\"\n[set]\n\"output.frames\" = 0\n\"output.checkpoint_interval\" = 0.01\n"
        "\"impact.repeat\" = 2\n[[axis]]\nkey = \"run.end_time\"\nvalues = [\"20 us\"]\n");
  const fs::path impacts = folder / "c/runs/end_time_20us";
  const Started started = start({"campaign", "study.campaign.toml", "--out", "c"});
  ASSERT_TRUE(wait_for(impacts / "impact_2/checkpoint.h5", started));
  const auto written = fs::last_write_time(impacts / "impact_1/report.json");
  ASSERT_TRUE(kill_run("end_time_20us"));
  ASSERT_EQ(wait(started).code, 0);
  EXPECT_EQ(fs::last_write_time(impacts / "impact_1/report.json"), written);
  ASSERT_EQ(run({"campaign", "study.campaign.toml", "--out", "undisturbed"}).code, 0);
  EXPECT_EQ(content(impacts / "impacts.csv"), content(folder / "undisturbed/runs/end_time_20us/impacts.csv"));
}

TEST_F(KilledRuns, FailWhenItHappensAgainAndAgain) {
  const Started started = start({"campaign", "study.campaign.toml", "--out", "c", "--jobs", "2"});
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(kill_run("seed_2"));
  const Ended ended = wait(started);
  EXPECT_EQ(ended.code, 1);
  EXPECT_THAT(ended.err, HasSubstr("error: seed_2: ended by signal 9, 3 times"));
  EXPECT_THAT(ended.out, HasSubstr("2 runs done (0 of them before), 1 failed"));
  EXPECT_EQ(run_campaign({"--retry"}).code, 0);
  expect_results_of_undisturbed_runs();
}

/// A test with a small disk of its own, the folder disk.
class FullDisks : public CampaignRuns {
 protected:
  void SetUp() override {
    fs::create_directory(disk);
    if (::mount("none", disk.c_str(), "tmpfs", 0, "size=20m") != 0) GTEST_SKIP() << "to mount a disk needs root";
    write("study.campaign.toml", seeds("[1, 2]", "6 us"));
  }
  ~FullDisks() override { ::umount2(disk.c_str(), MNT_DETACH); }

  void resize(std::uintmax_t bytes) const {
    ASSERT_EQ(::mount("none", disk.c_str(), "tmpfs", MS_REMOUNT, ("size=" + std::to_string(bytes)).c_str()), 0);
  }
  Ended run_on_disk() const { return run({"campaign", "study.campaign.toml", "--out", "disk/c", "--jobs", "1"}); }

  const fs::path disk = folder / "disk";
};

TEST_F(FullDisks, StopACampaignWhichThenGoesOn) {
  ASSERT_EQ(run_on_disk().code, 0);
  const fs::space_info space = fs::space(disk);
  const std::uintmax_t used = space.capacity - space.free;
  // From no room for the campaign's own files, over none for the first log or row, to none for the last run.
  for (const std::uintmax_t bytes :
       {std::uintmax_t{8192}, std::uintmax_t{24576}, std::uintmax_t{65536}, used / 4, used / 2, used - 16384}) {
    SCOPED_TRACE(bytes);
    fs::remove_all(disk / "c");
    resize(bytes);
    const Ended stopped = run_on_disk();
    EXPECT_EQ(stopped.code, 1);
    EXPECT_THAT(stopped.err, HasSubstr("disk/c"));
    EXPECT_THAT(stopped.err, HasSubstr("No space left on device"));
    EXPECT_FALSE(fs::exists(disk / "c/failures"));
    if (fs::exists(disk / "c/results.csv")) {
      EXPECT_EQ(results("disk/c").size(), 2u);
    }
    resize(std::uintmax_t{20} << 20U);
    const Ended ended = run_on_disk();
    EXPECT_EQ(ended.code, 0) << ended.err;
    expect_results_of_undisturbed_runs("disk/c");
  }
}

using UnwritableMessages = ProgramTest;

TEST_F(UnwritableMessages, LeaveTheExitCodeAlone) {
  const int status = std::system(KNAP_PROGRAM " check nowhere.toml 2>/dev/full");
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 2);
}

}  // namespace
}  // namespace knap
