// The files that tasks leave say how they ended; the queue says which are still to come. So nothing depends on Slurm's
// accounting, which many sites lack, nor on this process: it may die, and the next one finds jobs and ends in the
// folder. The alternative, one `sbatch --wait` or srun a run, loses the runs with the process and fills the site's
// queue.
#include "campaign/slurm_engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <thread>
#include <utility>

#include "campaign/slurm_client.hpp"
#include "core/errors.hpp"

namespace knap {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds between_looks(500);  // at the folder
constexpr milliseconds soon(1500);          // until the queue is asked again when something is to be expected
constexpr milliseconds late(30000);         // ... at most
// A task that the queue does not show in so many answers in a row, and that left no exit code, is lost.
constexpr int enough_misses = 3;
constexpr int interrupted = static_cast<int>(ExitCode::Interrupted);
constexpr std::size_t any_number = std::numeric_limits<std::size_t>::max();

// Refusals that a smaller array, or waiting, may get around.
bool is_limit(std::string words) {
  std::transform(words.begin(), words.end(), words.begin(), [](unsigned char c) { return std::tolower(c); });
  return words.find("limit") != std::string::npos || words.find("array") != std::string::npos;
}

class SlurmEngine : public Engine {
 public:
  explicit SlurmEngine(SlurmOptions options) : options_(std::move(options)) {}

  std::size_t free_slots() const override { return std::numeric_limits<int>::max(); }

  void start(const Job& job) override {
    begin();
    if (SlurmTask* task = under_way(job.name))
      task->run = job.run;
    else
      jobs_.push_back(job);
  }

  std::vector<JobEnd> wait(milliseconds patience) override {
    begin();
    const auto until = Clock::now() + patience;
    for (;;) {
      if (!is_stopping_) submit();
      if (Clock::now() >= next_question_) ask_queue();
      look_at_folder();
      if (!ended_.empty() || num_open() + jobs_.size() == 0 || Clock::now() >= until) break;
      std::this_thread::sleep_for(std::min(between_looks, patience));
    }
    return std::exchange(ended_, {});
  }

  void stop() override {
    is_stopping_ = true;
    give_up_jobs();
    cancel();
    expect_news();
  }

  EngineStatus status() const override {
    EngineStatus status{.queued = jobs_.size(), .remark = trouble_};
    std::size_t running = 0;
    for (const SlurmBatch& batch : batches_)
      for (const auto& [index, task] : batch.tasks)
        if (task.run) ++(task.is_pending ? status.queued : running);
    if (trouble_.empty() && running == 0 && status.queued > 0 && !why_pending_.empty())
      status.remark = fmt::format("Slurm: {}", why_pending_);
    return status;
  }

 private:
  // What earlier sessions left: what is neither in the queue nor has left an exit code is of no interest.
  void begin() {
    if (most_tasks_ > 0) return;
    most_tasks_ = static_cast<std::size_t>(max_array_size());
    batches_ = open_batches(options_.folder);
    std::string failure;
    const auto queue = queued_tasks(failure);
    if (!queue) throw RuntimeFailure(failure);
    for (SlurmBatch& batch : batches_) {
      if (!find_job(batch, *queue)) continue;
      read_exit_codes(batch);
      see(batch, *queue);
      std::erase_if(batch.tasks,
                    [](const auto& item) { return item.second.times_missed > 0 && !item.second.exit_code; });
    }
    close_batches();
    expect_news();
  }

  // The latest one of that name.
  SlurmTask* under_way(const std::string& name) {
    for (auto batch = batches_.rbegin(); batch != batches_.rend(); ++batch)
      for (auto& [index, task] : batch->tasks)
        if (task.name == name) return &task;
    return nullptr;
  }

  std::size_t num_open() const {
    std::size_t count = 0;
    for (const SlurmBatch& batch : batches_) count += batch.tasks.size();
    return count;
  }

  // With a limit on the tasks at a time there is one array at a time: each can only limit its own.
  void submit() {
    if (jobs_.empty() || num_open() > may_submit_at_ || (options_.most_running > 0 && num_open() > 0)) return;
    std::size_t size = most_tasks_;
    while (!jobs_.empty()) {
      size = std::min(size, jobs_.size());
      const auto end = jobs_.begin() + static_cast<std::ptrdiff_t>(size);
      const std::string refusal = submit_array({jobs_.begin(), end});
      if (refusal.empty()) {
        jobs_.erase(jobs_.begin(), end);
        if (options_.most_running > 0) break;
      } else if (size > 1 && is_limit(refusal)) {
        size /= 2;
      } else if (num_open() > 0) {
        trouble_ = refusal;
        may_submit_at_ = num_open() / 2;
        return;
      } else {
        throw RuntimeFailure(refusal);
      }
    }
    may_submit_at_ = any_number;
    trouble_.clear();
  }

  // Returns why Slurm does not take it. Whether it has is known by the queue, not by what sbatch says: an answer may
  // get lost. As long as the queue cannot be asked, the batch counts as submitted.
  std::string submit_array(const std::vector<Job>& jobs) {
    SlurmBatch batch = write_batch(options_, jobs);
    const SlurmAnswer answer =
        ask_slurm({"sbatch", "--parsable", "--output=" + output_option(batch), batch.file(".sh").string()});
    if (!answer.failure.empty()) {
      std::string failure;
      const auto queue = queued_tasks(failure);
      if (queue && !find_job(batch, *queue)) return answer.failure;
      if (!queue) batch.unsure_jobs = jobs;
    }
    batches_.push_back(std::move(batch));
    expect_news();
    if (answer.failure.empty()) record_job(batches_.back(), answer.text.substr(0, answer.text.find_first_of(";\n")));
    return "";
  }

  // Looks a batch up whose number is not known. False if it was not submitted; then it is gone.
  bool find_job(SlurmBatch& batch, const std::vector<QueuedTask>& queue) {
    if (!batch.job_id.empty()) return true;
    for (const QueuedTask& task : queue)
      if (task.job_name == batch.job_name) {
        record_job(batch, task.job_id);
        batch.unsure_jobs.clear();
        return true;
      }
    discard_batch(batch);
    batch.tasks.clear();
    return false;
  }

  void ask_queue() {
    std::string failure;
    const auto queue = queued_tasks(failure);
    pause_ = std::min(late, pause_ * 3 / 2);
    if (!queue) {
      trouble_ = fmt::format("Slurm does not answer, asking again: {}", failure);
    } else {
      if (may_submit_at_ == any_number) trouble_.clear();
      why_pending_.clear();
      for (SlurmBatch& batch : batches_) {
        if (!find_job(batch, *queue)) {
          take_back(batch);
          continue;
        }
        read_exit_codes(batch);  // after the queue: who has left it has left its code
        see(batch, *queue);
        settle(batch);
      }
      close_batches();
      if (is_stopping_) cancel();
    }
    next_question_ = Clock::now() + pause_;
  }

  void take_back(SlurmBatch& batch) {
    jobs_.insert(jobs_.end(), batch.unsure_jobs.begin(), batch.unsure_jobs.end());
    if (is_stopping_) give_up_jobs();
  }

  void give_up_jobs() {
    for (const Job& job : jobs_) ended_.push_back({job.run, interrupted});
    jobs_.clear();
  }

  void see(SlurmBatch& batch, const std::vector<QueuedTask>& queue) {
    std::map<int, const QueuedTask*> shown;
    for (const QueuedTask& task : queue)
      if (task.job_id == batch.job_id && task.job_name == batch.job_name) shown[task.index] = &task;
    for (auto& [index, task] : batch.tasks) {
      const auto found = shown.find(index);
      if (found != shown.end()) task.state = found->second->state;
      task.is_pending = found != shown.end() && found->second->is_pending();
      const bool is_over = found == shown.end() || found->second->is_over();
      task.times_missed = is_over ? task.times_missed + 1 : 0;
      if (is_over) expect_news();
      if (task.is_pending && task.run && found->second->reason != "None") why_pending_ = found->second->reason;
    }
  }

  // A good end is good at once; any other only when Slurm is through with the task, so that it is never there twice.
  void settle(SlurmBatch& batch) {
    for (auto it = batch.tasks.begin(); it != batch.tasks.end();) {
      const auto& [index, task] = *it;
      const bool is_over = task.times_missed >= (task.exit_code ? 1 : enough_misses);
      if (task.exit_code == 0 || is_over) {
        if (task.run) ended_.push_back(end_of(batch, index, task));
        forget_end(batch, index);
        it = batch.tasks.erase(it);
      } else {
        ++it;
      }
    }
  }

  JobEnd end_of(const SlurmBatch& batch, int index, const SlurmTask& task) const {
    JobEnd end{.run = *task.run, .exit_code = task.exit_code.value_or(interrupted), .is_lost = !task.exit_code};
    if (end.exit_code == 0) return end;
    const std::string words = words_of_slurm(batch, index);
    end.reason = fmt::format("Slurm: job {}_{}{}{}{}{}", batch.job_id, index, task.state.empty() ? "" : ", ",
                             task.state, words.empty() ? "" : ", ", words);
    return end;
  }

  void look_at_folder() {
    for (SlurmBatch& batch : batches_) {
      if (read_exit_codes(batch) > 0) expect_news();
      settle(batch);
    }
    close_batches();
  }

  void close_batches() {
    std::erase_if(batches_, [](const SlurmBatch& batch) {
      if (batch.tasks.empty()) close_batch(batch);
      return batch.tasks.empty();
    });
  }

  // Tries again with every answer of the queue until Slurm has heard it.
  void cancel() {
    for (SlurmBatch& batch : batches_) {
      if (batch.job_id.empty() || batch.is_cancelled) continue;
      const SlurmAnswer answer = ask_slurm({"scancel", "--name=" + batch.job_name, batch.job_id});
      batch.is_cancelled = answer.failure.empty();
    }
  }

  void expect_news() {
    pause_ = soon;
    next_question_ = std::min(next_question_, Clock::now() + pause_);
  }

  SlurmOptions options_;
  std::size_t most_tasks_ = 0;  // of an array; 0 = nothing was asked yet
  std::vector<Job> jobs_;       // not submitted yet
  std::vector<SlurmBatch> batches_;
  std::vector<JobEnd> ended_;
  std::size_t may_submit_at_ = any_number;  // open tasks; after a refusal fewer than there were
  milliseconds pause_ = soon;
  Clock::time_point next_question_ = Clock::time_point::max();
  std::string trouble_, why_pending_;
  bool is_stopping_ = false;
};

}  // namespace

std::unique_ptr<Engine> make_slurm_engine(SlurmOptions options) {
  return std::make_unique<SlurmEngine>(std::move(options));
}

std::string open_slurm_jobs(const std::filesystem::path& campaign_folder) {
  std::string list;
  for (const SlurmBatch& batch : open_batches(campaign_folder))
    list += (list.empty() ? "" : ", ") + (batch.job_id.empty() ? batch.job_name : batch.job_id);
  return list;
}

}  // namespace knap
