#include "campaign/slurm_client.hpp"

#include <gmock/gmock.h>

namespace knap {
namespace {

TEST(SlurmClient, ReadsTheQueue) {
  const auto tasks = queued_tasks_of_text(
      "12|0|RUNNING|None|knap_a_batch_0001_0123abcd\n"
      "12|1|PENDING|Resources|knap_a_batch_0001_0123abcd\n"
      "13|N/A|RUNNING|None|no array\n"
      "14|7|NODE_FAIL|NodeDown|a|b\n"
      "slurm_load_jobs: warning\n");
  ASSERT_EQ(tasks.size(), 3u);
  EXPECT_EQ(tasks[0].job_id, "12");
  EXPECT_EQ(tasks[0].job_name, "knap_a_batch_0001_0123abcd");
  EXPECT_TRUE(tasks[1].is_pending());
  EXPECT_EQ(tasks[1].reason, "Resources");
  EXPECT_EQ(tasks[2].index, 7);
  EXPECT_EQ(tasks[2].job_name, "a|b");
}

TEST(SlurmClient, KnowsWhatIsOver) {
  for (const char* state : {"COMPLETED", "NODE_FAIL", "CANCELLED", "TIMEOUT", "OUT_OF_MEMORY"})
    EXPECT_TRUE(QueuedTask({"1", 0, state, "None", "a"}).is_over()) << state;
  for (const char* state : {"PENDING", "RUNNING", "COMPLETING", "REQUEUED", "SUSPENDED", "NEW_IN_A_LATER_VERSION"})
    EXPECT_FALSE(QueuedTask({"1", 0, state, "None", "a"}).is_over()) << state;
}

TEST(SlurmClient, ReadsTheLargestArray) {
  EXPECT_EQ(max_array_size_of_text("LogTimeFormat = iso\nMaxArraySize            = 1001\nMaxDBDMsgs = 20008\n"), 1001);
  EXPECT_EQ(max_array_size_of_text("nothing\n"), 0);
}

}  // namespace
}  // namespace knap
