// A run that was stopped at any moment goes on as if nothing had happened.
#include <gmock/gmock.h>

#include "tests/app/program.hpp"

namespace knap {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class Resume : public ProgramTest {
 protected:
  Resume() { write("case.toml", breaking_case); }

  std::vector<std::string> command(const std::string& out) const {
    return {"run", "case.toml", "--quiet", "--threads", "1", "--set", "output.checkpoint_interval=0.02", "--out", out};
  }
  // Sends the signal once the run has taken a checkpoint.
  Ended stopped_by(int signal, const std::string& out) const {
    const Started started = start(command(out));
    EXPECT_TRUE(wait_for(folder / out / "checkpoint.h5", started));
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    ::kill(started.pid, signal);
    return wait(started);
  }
  Ended resumed(const std::string& out) const {
    auto arguments = command(out);
    arguments.push_back("--resume");
    return run(arguments);
  }
  std::size_t num_files(const std::filesystem::path& path) const {
    const std::filesystem::directory_iterator files(folder / path);
    return static_cast<std::size_t>(std::distance(begin(files), end(files)));
  }
  void expect_same_results(const std::string& a, const std::string& b) const {
    EXPECT_EQ(report(a)["state_hash"], report(b)["state_hash"]);
    EXPECT_EQ(report(a)["energy"], report(b)["energy"]);
    EXPECT_EQ(content(folder / a / "history.csv"), content(folder / b / "history.csv"));
    EXPECT_EQ(content(folder / a / "frames.pvd"), content(folder / b / "frames.pvd"));
    EXPECT_EQ(content(folder / a / "cracks.pvd"), content(folder / b / "cracks.pvd"));
    EXPECT_EQ(num_files(a + "/frames"), num_files(b + "/frames"));
  }
};

TEST_F(Resume, KilledRunEndsAsIfNeverKilled) {
  ASSERT_EQ(run(command("whole")).code, 0);
  ASSERT_EQ(stopped_by(SIGKILL, "killed").code, 128 + SIGKILL);
  EXPECT_FALSE(std::filesystem::exists(folder / "killed/report.json"));
  const Ended ended = resumed("killed");
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_GT(report("killed")["performance"]["resumed_from_step"], 0);
  expect_same_results("whole", "killed");
}

TEST_F(Resume, InterruptedRunReportsAndEndsAsIfNeverInterrupted) {
  ASSERT_EQ(run(command("whole")).code, 0);
  const Ended stopped = stopped_by(SIGINT, "interrupted");
  EXPECT_EQ(stopped.code, 130);
  EXPECT_THAT(stopped.err, HasSubstr("--resume"));
  EXPECT_EQ(report("interrupted")["status"], "interrupted");
  EXPECT_EQ(report("interrupted")["stop_reason"], "interrupted");
  EXPECT_TRUE(std::filesystem::exists(folder / "interrupted/fragments.csv"));
  const Ended ended = resumed("interrupted");
  ASSERT_EQ(ended.code, 0) << ended.err;
  expect_same_results("whole", "interrupted");
}

TEST_F(Resume, TerminatedTwiceStillEndsTheSame) {
  ASSERT_EQ(run(command("whole")).code, 0);
  ASSERT_EQ(stopped_by(SIGTERM, "twice").code, 130);
  auto arguments = command("twice");
  arguments.push_back("--resume");
  const Started again = start(arguments);
  std::this_thread::sleep_for(std::chrono::milliseconds(600));
  ::kill(again.pid, SIGKILL);
  wait(again);
  ASSERT_EQ(resumed("twice").code, 0);
  expect_same_results("whole", "twice");
}

TEST_F(Resume, WithoutACheckpointSaysSo) {
  ASSERT_EQ(run({"run", "case.toml", "--quiet", "--out", "done", "--set", "output.checkpoint_interval=0", "--set",
                 "run.end_time=1us"})
                .code,
            0);
  const Ended ended = run({"run", "case.toml", "--out", "done", "--resume", "--set", "run.end_time=1us"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("checkpoint.h5"));
}

TEST_F(Resume, OfAnotherCaseNamesTheKey) {
  ASSERT_EQ(stopped_by(SIGINT, "stopped").code, 130);
  const Ended ended = run({"run", "case.toml", "--resume", "--out", "stopped", "--set", "impact.speed=26m/s"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("impact.speed was 25 there and is 26 now"));
}

TEST_F(Resume, WithTheCheckpointOfAnotherCaseIsAnError) {
  ASSERT_EQ(stopped_by(SIGINT, "stopped").code, 130);
  auto faster = command("faster");
  faster.insert(faster.end(), {"--set", "impact.speed=26m/s", "--set", "run.end_time=1us"});
  ASSERT_EQ(run(faster).code, 0);
  std::filesystem::copy_file(folder / "stopped/checkpoint.h5", folder / "faster/checkpoint.h5",
                             std::filesystem::copy_options::overwrite_existing);
  faster.push_back("--resume");
  const Ended ended = run(faster);
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, AllOf(HasSubstr("faster/checkpoint.h5"), HasSubstr("another case")));
}

TEST_F(Resume, OfNoRunIsAnError) {
  EXPECT_EQ(run({"run", "case.toml", "--resume", "--out", "nowhere"}).code, 2);
  std::filesystem::create_directory(folder / "empty");
  const Ended ended = run({"run", "case.toml", "--resume", "--out", "empty"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("no run of Knap"));
}

}  // namespace
}  // namespace knap
