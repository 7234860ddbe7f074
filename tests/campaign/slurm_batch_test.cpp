#include "campaign/slurm_batch.hpp"

#include <gmock/gmock.h>

#include "io/called_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace knap {
namespace {

using SlurmBatches = TemporaryFolder;
using testing::HasSubstr;

// As Slurm would: task `index` of a batch.
int run_task(const SlurmBatch& batch, int index) {
  return call_program({"env", "SLURM_ARRAY_TASK_ID=" + std::to_string(index), "bash", batch.file(".sh").string()},
                      std::chrono::seconds(60))
      .exit_code;
}

TEST_F(SlurmBatches, RunTheirCommandsWhateverTheyAreCalled) {
  const std::filesystem::path odd = folder / "it's a \"c\" %a $HOME `x` \\ \n ü";
  create_directory(odd);
  const std::string word = "*; $(false) 'a' \\n \t\n!\"";
  const SlurmBatch batch = write_batch(
      {.folder = odd},
      {{3, "first", {"false"}, odd / "first.txt"}, {5, "second", {"printf", "%s|%s", word, ""}, odd / "second.txt"}});
  EXPECT_EQ(run_task(batch, 1), 0);
  EXPECT_EQ(content(odd / "second.txt"), word + "|");
  EXPECT_EQ(run_task(batch, 0), 1);
  auto open = open_batches(odd);
  ASSERT_EQ(open.size(), 1u);
  read_exit_codes(open[0]);
  EXPECT_EQ(open[0].job_name, batch.job_name);
  EXPECT_EQ(open[0].tasks.at(0).name, "first");
  EXPECT_EQ(open[0].tasks.at(0).exit_code, 1);
  EXPECT_EQ(open[0].tasks.at(1).exit_code, 0);
  close_batch(open[0]);
  EXPECT_TRUE(open_batches(odd).empty());
}

TEST_F(SlurmBatches, DoNothingOnceDiscarded) {
  const SlurmBatch batch =
      write_batch({.folder = folder}, {{0, "run", {"touch", (folder / "ran").string()}, folder / "log"}});
  discard_batch(batch);
  EXPECT_EQ(run_task(batch, 0), 1);
  EXPECT_FALSE(exists(folder / "ran"));
  EXPECT_NE(write_batch({.folder = folder}, {{0, "run", {"true"}, folder / "log"}}).stem, batch.stem);
}

TEST_F(SlurmBatches, TellSlurmTheOptions) {
  const SlurmBatch batch =
      write_batch({.folder = folder, .most_running = 7, .cpus = 4, .more = "--partition=long --mem=2G"},
                  {{0, "a", {"true"}, folder / "a.txt"}, {1, "b", {"true"}, folder / "b.txt"}});
  const std::string script = content(batch.file(".sh"));
  for (const char* line : {"--array=0-1%7\n", "--cpus-per-task=4\n", "--partition=long --mem=2G\n", "--no-requeue\n"})
    EXPECT_THAT(script, HasSubstr(line));
}

}  // namespace
}  // namespace knap
