#include "observers/checkpoints.hpp"

#include <gtest/gtest.h>

#include "simulation/persistent_arrays.hpp"
#include "tests/observers/breaking_box.hpp"

namespace knap {
namespace {

using CheckpointsTest = ObserverTest;

TEST_F(CheckpointsTest, ZeroMeansOnlyWhenAsked) {
  Simulation s = breaking_box();
  Checkpoints checkpoints(folder / "checkpoint.h5", 0.0);
  checkpoints.look(s);
  EXPECT_FALSE(std::filesystem::exists(folder / "checkpoint.h5"));
  checkpoints.write(s);
  EXPECT_TRUE(std::filesystem::exists(folder / "checkpoint.h5"));
}

TEST_F(CheckpointsTest, RestoredRunGoesOnWithTheSameBits) {
  Simulation s = breaking_box();
  advance(s, 200);
  Checkpoints checkpoints(folder / "checkpoint.h5", 1e-9);
  checkpoints.look(s);
  Simulation again = breaking_box();
  restore_checkpoint(again, read_checkpoint(folder / "checkpoint.h5"));
  EXPECT_EQ(state_hash(again), state_hash(s));
  advance(s, 150);
  advance(again, 150);
  EXPECT_EQ(state_hash(again), state_hash(s));
}

}  // namespace
}  // namespace knap
