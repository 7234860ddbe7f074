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

}  // namespace
}  // namespace knap
