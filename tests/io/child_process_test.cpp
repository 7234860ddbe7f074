#include "io/child_process.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <stdexcept>

namespace knap {
namespace {

using namespace std::chrono_literals;

TEST(ChildProcess, HandsBackBytesLongerThanAPipe) {
  std::string bytes(1000000, 'a');
  bytes[500] = '\0';
  const ChildResult result = run_in_child([&] { return bytes; }, 20s);
  EXPECT_EQ(result.failure, "");
  EXPECT_EQ(result.output, bytes);
}

TEST(ChildProcess, ChangesNothingHere) {
  int touched = 0;
  run_in_child([&] { return std::to_string(touched = 1); }, 20s);
  EXPECT_EQ(touched, 0);
}

TEST(ChildProcess, ExceptionBecomesAFailure) {
  const ChildResult result = run_in_child([]() -> std::string { throw std::runtime_error("no light"); }, 20s);
  EXPECT_EQ(result.failure, "failed: no light");
}

TEST(ChildProcess, CrashBecomesAFailureWithItsLastWords) {
  const auto work = []() -> std::string {
    std::signal(SIGABRT, SIG_DFL);
    std::fputs("\x1b[0m\x1b[31mbad X server\n connection\x1b[0m\n", stderr);
    std::abort();
  };
  EXPECT_EQ(run_in_child(work, 20s).failure, "crashed (Aborted): bad X server connection");
}

TEST(ChildProcess, ExitBecomesAFailure) {
  EXPECT_EQ(run_in_child([]() -> std::string { std::exit(0); }, 20s).failure, "failed");
}

TEST(ChildProcess, HangEndsAtTheTimeout) {
  const auto begin = std::chrono::steady_clock::now();
  const auto work = [] {
    for (;;) pause();
    return std::string();
  };
  EXPECT_EQ(run_in_child(work, 1s).failure, "no result after 1 s");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 10s);
}

TEST(ChildProcess, HangWithClosedPipesEndsAtTheTimeout) {
  const auto work = [] {
    for (int descriptor = 0; descriptor < 100; ++descriptor) close(descriptor);
    for (;;) pause();
    return std::string();
  };
  EXPECT_EQ(run_in_child(work, 1s).failure, "no result after 1 s");
}

}  // namespace
}  // namespace knap
