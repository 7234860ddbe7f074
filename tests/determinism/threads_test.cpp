#include <gmock/gmock.h>

#include "tests/app/program.hpp"

namespace knap {
namespace {

using Threads = ProgramTest;

TEST_F(Threads, AnyNumberGivesTheSameBits) {
  write("case.toml", breaking_case);
  std::string hash;
  std::string history;
  for (const char* threads : {"1", "2", "3", "8"}) {
    const std::string out = std::string("with_") + threads;
    const Ended ended = run({"run", "case.toml", "--quiet", "--threads", threads, "--out", out});
    ASSERT_EQ(ended.code, 0) << ended.err;
    if (hash.empty()) {
      hash = report(out)["state_hash"];
      history = content(folder / out / "history.csv");
    }
    EXPECT_EQ(report(out)["state_hash"], hash) << threads;
    EXPECT_EQ(content(folder / out / "history.csv"), history) << threads;
    EXPECT_EQ(report(out)["performance"]["threads"], std::stoi(threads));
  }
  EXPECT_GT(report("with_1")["cracks"]["inserted_facets"], 100);
}

// Intrinsic insertion: the same bits, whether by one thread or by three, at once or in two parts.
TEST_F(Threads, IntrinsicCracksGiveTheSameBits) {
  write("case.toml", breaking_case);
  const auto command = [](const char* threads, const char* out) -> std::vector<std::string> {
    return {"run",       "case.toml",       "--quiet",
            "--threads", threads,           "--out",
            out,         "--set",           "fracture.insertion=intrinsic",
            "--set",     "run.end_time=3us"};
  };
  ASSERT_EQ(run(command("1", "one")).code, 0);
  ASSERT_EQ(run(command("3", "three")).code, 0);
  EXPECT_EQ(report("one")["state_hash"], report("three")["state_hash"]);
  EXPECT_GT(report("one")["cracks"]["inserted_facets"], 100);

  auto in_parts = command("1", "parts");
  in_parts.insert(in_parts.end(), {"--set", "output.checkpoint_interval=0.02"});
  const Started started = start(in_parts);
  ASSERT_TRUE(wait_for(folder / "parts/checkpoint.h5", started));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  ::kill(started.pid, SIGKILL);
  ASSERT_EQ(wait(started).code, 128 + SIGKILL);
  in_parts.push_back("--resume");
  const Ended ended = run(in_parts);
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_GT(report("parts")["performance"]["resumed_from_step"], 0);
  EXPECT_EQ(report("one")["state_hash"], report("parts")["state_hash"]);
}

}  // namespace
}  // namespace knap
