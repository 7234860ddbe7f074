#include "io/called_program.hpp"

#include <gtest/gtest.h>

#include <csignal>

namespace knap {
namespace {

constexpr std::chrono::seconds minute(60);

TEST(CalledProgram, SaysHowItEnded) {
  const ProgramEnd end = call_program({"sh", "-c", "echo out; echo err >&2; exit 3"}, minute);
  EXPECT_EQ(end.exit_code, 3);
  EXPECT_EQ(end.out, "out\n");
  EXPECT_EQ(end.err, "err\n");
  EXPECT_EQ(call_program({"sh", "-c", "kill -KILL $$"}, minute).exit_code, 128 + SIGKILL);
  EXPECT_EQ(call_program({"no_such_program_anywhere"}, minute).exit_code, 127);
}

TEST(CalledProgram, SaysAsMuchAsItLikes) {
  EXPECT_EQ(call_program({"head", "-c", "1000000", "/dev/zero"}, minute).out.size(), 1000000u);
}

TEST(CalledProgram, IsKilledWhenItHangs) {
  EXPECT_EQ(call_program({"sleep", "1000"}, std::chrono::seconds(0)).exit_code, 128 + SIGKILL);
}

}  // namespace
}  // namespace knap
