#include "io/virtual_display.hpp"

#include <gtest/gtest.h>

#include <filesystem>

namespace knap {
namespace {

using namespace std::chrono_literals;

TEST(VirtualDisplay, EachHasItsOwnNumberAndLeavesNothing) {
  std::string socket;
  {
    const VirtualDisplay first(20s);
    const VirtualDisplay second(20s);
    EXPECT_NE(first.name(), second.name());
    socket = "/tmp/.X11-unix/X" + first.name().substr(1);
    EXPECT_TRUE(std::filesystem::exists(socket));
  }
  EXPECT_FALSE(std::filesystem::exists(socket));
}

}  // namespace
}  // namespace knap
