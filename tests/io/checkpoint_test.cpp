#include "io/checkpoint.hpp"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <bit>
#include <chrono>
#include <cmath>
#include <csignal>
#include <limits>
#include <thread>

#include "core/errors.hpp"
#include "tests/io/full_disk.hpp"
#include "tests/support/temporary_folder.hpp"

namespace knap {
namespace {

using testing::HasSubstr;

class CheckpointFile : public TemporaryFolder {
 protected:
  std::filesystem::path path() const { return folder / "checkpoint.h5"; }
  void overwrite(const std::string& bytes) { std::ofstream(path(), std::ios::binary) << bytes; }
  std::string refusal() {
    return message_of<InputError>([&] { read_checkpoint(path()); });
  }
};

Checkpoint sample() {
  Checkpoint checkpoint;
  const double payload_nan = std::bit_cast<double>(0x7ff8dead0000beefULL);
  checkpoint.doubles["nodes/x [m]"] = {0.1,
                                       -0.0,
                                       std::nan(""),
                                       payload_nan,
                                       std::numeric_limits<double>::infinity(),
                                       std::numeric_limits<double>::denorm_min()};
  checkpoint.doubles["nodes/v [m/s]"] = std::vector<double>(3000, 1.0 / 3.0);
  checkpoint.doubles["none"] = {};
  checkpoint.ints["tet_nodes"] = {0, -1, std::numeric_limits<std::int32_t>::min()};
  checkpoint.bytes["facet_state"] = {0, 255, 7};
  checkpoint.texts["case"] = std::string("[case]\nname = \"\xC2\xB5 \0\"\n\0", 22);
  checkpoint.texts["empty"] = "";
  return checkpoint;
}

TEST_F(CheckpointFile, ReadsBackTheSameBits) {
  const Checkpoint checkpoint = sample();
  write_checkpoint(path(), checkpoint);
  EXPECT_EQ(num_files(), 1u);
  const Checkpoint read = read_checkpoint(path());
  EXPECT_EQ(read.version, checkpoint_version);
  EXPECT_EQ(read.ints, checkpoint.ints);
  EXPECT_EQ(read.bytes, checkpoint.bytes);
  EXPECT_EQ(read.texts, checkpoint.texts);
  ASSERT_EQ(read.doubles.size(), checkpoint.doubles.size());
  for (const auto& [name, values] : checkpoint.doubles) {
    const std::vector<double>& same = read.doubles.at(name);
    ASSERT_EQ(same.size(), values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(same[i]), std::bit_cast<std::uint64_t>(values[i])) << name << i;
    }
  }
}

TEST_F(CheckpointFile, EmptyCheckpointReadsBack) {
  write_checkpoint(path(), {});
  EXPECT_TRUE(read_checkpoint(path()).doubles.empty());
}

TEST_F(CheckpointFile, SameContentMakesTheSameFile) {
  write_checkpoint(path(), sample());
  const std::string first = content(path());
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // HDF5 would note the second
  write_checkpoint(path(), sample());
  EXPECT_EQ(content(path()), first);
}

TEST_F(CheckpointFile, AnyFlippedBitIsNoticed) {
  write_checkpoint(path(), sample());
  const std::string whole = content(path());
  std::vector<std::size_t> places{0, 20, 30, 60, 100, 511, 512, 520, 600, whole.size() - 1};
  for (std::size_t i = 700; i < whole.size(); i += 997) places.push_back(i);
  for (const std::size_t place : places) {
    for (const int bit : {0, 3, 7}) {
      std::string changed = whole;
      changed[place] = static_cast<char>(changed[place] ^ (1 << bit));
      overwrite(changed);
      EXPECT_NE(refusal(), "") << "byte " << place << " bit " << bit;
    }
  }
  overwrite(whole);
  EXPECT_EQ(refusal(), "");
}

TEST_F(CheckpointFile, CorruptedContentIsCalledSo) {
  write_checkpoint(path(), sample());
  std::string bytes = content(path());
  bytes[bytes.size() / 2] ^= 1;
  overwrite(bytes);
  EXPECT_THAT(refusal(), HasSubstr("checkpoint.h5: corrupted checkpoint"));
}

TEST_F(CheckpointFile, TruncationAtAnyLengthIsNoticed) {
  write_checkpoint(path(), sample());
  const std::string whole = content(path());
  for (const std::size_t size :
       {std::size_t{17}, std::size_t{100}, std::size_t{512}, std::size_t{600}, whole.size() / 2, whole.size() - 1}) {
    overwrite(whole.substr(0, size));
    EXPECT_THAT(refusal(), HasSubstr("truncated checkpoint")) << size;
  }
  overwrite(whole + "x");
  EXPECT_THAT(refusal(), HasSubstr("corrupted checkpoint"));
}

TEST_F(CheckpointFile, ForeignAndMissingFilesAreRefused) {
  EXPECT_THAT(refusal(), HasSubstr("no such checkpoint"));
  for (const std::string& text : {std::string(), std::string("[case]\n"), std::string(5000, '\0')}) {
    overwrite(text);
    EXPECT_THAT(refusal(), HasSubstr("checkpoint.h5: not a Knap checkpoint"));
  }
  EXPECT_THROW(read_checkpoint(folder), InputError);
}

TEST_F(CheckpointFile, UnknownVersionIsRefusedNamingTheKnownOne) {
  Checkpoint checkpoint = sample();
  checkpoint.version = 99;
  write_checkpoint(path(), checkpoint);
  EXPECT_THAT(refusal(), HasSubstr("checkpoint of version 99, this program knows version 1 only"));
}

TEST_F(CheckpointFile, FailedWriteLeavesTheOldCheckpoint) {
  write_checkpoint(path(), sample());
  Checkpoint larger;
  larger.doubles["x"].resize(100000);
  const std::string message = message_of<RuntimeFailure>([&] {
    const FullDisk full(50000);
    write_checkpoint(path(), larger);
  });
  EXPECT_THAT(message, HasSubstr("checkpoint.h5: cannot write: File too large"));
  EXPECT_EQ(read_checkpoint(path()).texts, sample().texts);
  EXPECT_EQ(num_files(), 1u);
  EXPECT_THROW(write_checkpoint(below_a_file("checkpoint.h5"), sample()), RuntimeFailure);
}

TEST_F(CheckpointFile, KilledWriterLeavesAWholeCheckpoint) {
  Checkpoint checkpoint;
  checkpoint.doubles["x"].resize(200000, 1.0);
  write_checkpoint(path(), checkpoint);
  for (unsigned delay = 0; delay < 10; ++delay) {
    const pid_t writer = fork();
    ASSERT_GE(writer, 0);
    if (writer == 0) {
      for (;;) write_checkpoint(path(), checkpoint);
    }
    usleep(3000 + 1700 * delay);
    kill(writer, SIGKILL);
    waitpid(writer, nullptr, 0);
    EXPECT_EQ(read_checkpoint(path()).doubles, checkpoint.doubles);
  }
}

TEST_F(CheckpointFile, FileIsOrdinaryHdf5BehindItsSeal) {
  write_checkpoint(path(), sample());
  EXPECT_EQ(content(path()).substr(512, 8), "\x89HDF\r\n\x1a\n");
}

}  // namespace
}  // namespace knap
