#pragma once
// What is asked of Slurm, through its own commands: they are at every site, and know how to reach its controller.
#include <optional>
#include <string>
#include <vector>

namespace knap {

/// What a command of Slurm said; `failure` is not empty if it failed: the name of the command and its words.
struct SlurmAnswer {
  std::string text;
  std::string failure;
};
/// Calls "sbatch", "squeue", "scancel" or "scontrol" with its arguments.
SlurmAnswer ask_slurm(const std::vector<std::string>& words);

/// A task of an array as the queue shows it.
struct QueuedTask {
  std::string job_id;  ///< of the array
  int index = 0;       ///< in it
  std::string state;   ///< "RUNNING"
  std::string reason;  ///< why it is in that state; "None"
  std::string job_name;

  bool is_pending() const { return state == "PENDING"; }
  /// It will not run any more.
  bool is_over() const;
};

/// All array tasks of this user, those that ended lately too; nothing if Slurm does not answer, and then `failure` says
/// why.
std::optional<std::vector<QueuedTask>> queued_tasks(std::string& failure);
/// The same from the text that squeue prints.
std::vector<QueuedTask> queued_tasks_of_text(const std::string& text);

/// How many tasks an array may have here. Throws RuntimeFailure if Slurm does not answer, or takes no arrays.
int max_array_size();
/// The same from the text that `scontrol show config` prints; 0 = it does not say.
int max_array_size_of_text(const std::string& text);

}  // namespace knap
