#pragma once
// One array job and its files in the campaign's folder. They are all that a later process knows of it, and what a user
// reads who wants to know what was submitted:
//   slurm/batch_0001.sh      the script
//   slurm/batch_0001.tasks   a line a task: run, log, command, as the shell takes them
//   slurm/batch_0001.job     the number Slurm gave it
//   slurm/batch_0001/        as long as it has tasks under way; 7.end holds the exit code of task 7, slurm_7.txt what
//                            Slurm has to say of it
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "campaign/engine.hpp"

namespace knap {

struct SlurmOptions {
  std::filesystem::path folder;  ///< of the campaign
  int most_running = 0;          ///< tasks at a time; 0 = as many as Slurm runs
  int cpus = 0;                  ///< of a task; 0 = the site's default
  std::string more{};            ///< options of sbatch: "--partition=long --time=2:00:00"
};

/// A task of an array that is not over, or whose end nobody has been told yet.
struct SlurmTask {
  std::string name;                  ///< of its run
  std::optional<std::size_t> run{};  ///< of this session's jobs; none = nobody waits for it
  bool is_pending = true;
  std::optional<int> exit_code{};  ///< it has left one
  std::string state{};             ///< last seen in the queue
  int times_missed = 0;            ///< asked for in a row without being in the queue
};

struct SlurmBatch {
  std::filesystem::path stem;  ///< slurm/batch_0001
  std::string job_name;        ///< no other job has it, while numbers come again where Slurm has lost its memory
  std::string job_id{};        ///< "" = not known, perhaps not submitted
  bool is_cancelled = false;
  std::vector<Job> unsure_jobs{};    ///< its jobs, as long as nobody knows whether it was submitted
  std::map<int, SlurmTask> tasks{};  ///< by index

  std::filesystem::path file(const char* ending) const { return stem.string() + ending; }
};

/// Where the batches of a campaign lie.
std::filesystem::path slurm_folder(const std::filesystem::path& campaign_folder);
/// The text as one word of the shell.
std::string shell_word(const std::string& text);

/// Writes the files of a new batch; nothing is submitted. Throws RuntimeFailure if the disk does not take them.
SlurmBatch write_batch(const SlurmOptions& options, const std::vector<Job>& jobs);
/// The number that Slurm gave a batch, to be found by a later process.
void record_job(SlurmBatch& batch, const std::string& job_id);
/// The batches that have tasks under way as far as the folder knows, by age.
std::vector<SlurmBatch> open_batches(const std::filesystem::path& campaign_folder);
/// Takes over the exit codes that tasks have left; returns how many were new.
int read_exit_codes(SlurmBatch& batch);
/// The task is settled: its exit code is not told again.
void forget_end(const SlurmBatch& batch, int index);
/// sbatch --output: where Slurm puts what it has to say of a task.
std::string output_option(const SlurmBatch& batch);
/// What Slurm itself said of a task last; "" = nothing.
std::string words_of_slurm(const SlurmBatch& batch, int index);
/// No task is under way any more.
void close_batch(const SlurmBatch& batch);
/// It was not submitted. Should Slurm have got it all the same, its tasks find no commands and do nothing.
void discard_batch(const SlurmBatch& batch);

}  // namespace knap
