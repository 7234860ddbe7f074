#include "campaign/run_campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <deque>
#include <thread>
#include <utility>

#include "campaign/results_table.hpp"
#include "core/errors.hpp"
#include "io/file_output.hpp"
#include "io/folder_lock.hpp"

namespace knap {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds patience(500);
// The table is written anew at most so often, and at the end.
constexpr std::chrono::seconds between_tables(2);
// A run that another process still holds, a left-over of a killed campaign that is about to stop, is tried that often.
constexpr int most_tries = 60;
constexpr std::chrono::milliseconds between_tries(500);
// A run that was killed from outside, or lost with its machine, is tried that often: it may have been bad luck.
constexpr int most_losses = 3;

void make_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw InputError(fmt::format("{}: cannot make this folder: {}", path.string(), error.message()));
}

// The folder keeps its campaign as it was last run; nothing else's folder becomes one. A campaign may grow.
void prepare_folder(const CampaignFolder& folder, const std::string& campaign_text) {
  if (!fs::exists(folder.campaign()) && !fs::is_empty(folder.path))
    throw InputError(
        fmt::format("{}: is not empty and holds no campaign (no campaign.toml); give another folder with --out",
                    folder.path.string()));
  write_text_atomically(folder.campaign(), campaign_text);
  make_folder(folder.runs());
  make_folder(folder.path / "logs");
}

std::string times(int losses) { return losses > 1 ? fmt::format(", {} times", losses) : ""; }

bool is_interrupted(const JobEnd& end) {
  return !end.is_lost && end.exit_code == static_cast<int>(ExitCode::Interrupted);
}

// Killed from outside, rather than ended by a fault of its own.
bool is_kill(const JobEnd& end) {
  return end.is_lost || end.exit_code == 128 + SIGKILL || end.exit_code == 128 + SIGTERM ||
         end.exit_code == 128 + SIGHUP;
}

/// What was done here when a run ended.
struct Pace {
  Clock::time_point time;
  double effort = 0.0;
};

/// A campaign under way.
class Session {
 public:
  Session(const CampaignConfig& campaign, const CampaignOptions& options, Engine& engine)
      : campaign_(campaign),
        options_(options),
        engine_(engine),
        runs_(campaign_runs(campaign)),
        status_(runs_.size()),
        tries_(runs_.size(), 0),
        losses_(runs_.size(), 0),
        table_(options.folder, campaign, runs_) {
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      status_[i] = status_of(options.folder, campaign, runs_[i]);
      if (status_[i].state == RunState::Failed && options.retries_failed) {
        forget_failure(options.folder, runs_[i]);
        status_[i] = status_of(options.folder, campaign, runs_[i]);
      }
      if (status_[i].state == RunState::Waiting) waiting_.push_back(i);
      if (status_[i].state == RunState::Done) ++done_before_;
      table_.set(i, status_[i]);
    }
    table_.write();
  }

  CampaignProgress run(const std::function<void(const CampaignProgress&)>& tell, const std::atomic<bool>& stop) {
    while (running_ > 0 || (!waiting_.empty() && !is_stopping_)) {
      if (stop) stop_runs();
      while (!is_stopping_ && !waiting_.empty() && engine_.free_slots() > 0) start_next();
      tell(progress());
      for (const JobEnd& end : engine_.wait(patience)) settle(end);
      if (is_changed_ && disk_failure_.empty() && Clock::now() - written_ > between_tables) write_table();
    }
    if (!disk_failure_.empty()) throw RuntimeFailure(disk_failure_);
    write_table();
    tell(progress());
    return progress();
  }

  void stop_runs() {
    if (!std::exchange(is_stopping_, true)) engine_.stop();
  }

 private:
  void start_next() {
    const std::size_t i = waiting_.front();
    waiting_.pop_front();
    const CampaignRun& run = runs_[i];
    std::vector<std::string> command{options_.program.string(), "run", campaign_.base.string()};
    for (const Setting& setting : settings_of(campaign_, run)) command.insert(command.end(), {"--set", setting.text});
    command.insert(command.end(), {"--out", options_.folder.run(run).string(), "--quiet",
                                   status_[i].can_resume ? "--resume" : "--overwrite"});
    engine_.start({i, run.name, std::move(command), options_.folder.log(run)});
    status_[i].state = RunState::Running;
    ++running_;
  }

  void settle(const JobEnd& end) {
    const CampaignRun& run = runs_[end.run];
    --running_;
    const bool was_resumed = status_[end.run].can_resume;
    const std::string reason = reason_of(options_.folder, run, end);
    status_[end.run] = status_of(options_.folder, campaign_, run);
    if (status_[end.run].state == RunState::Done) {
      effort_here_ += effort_of(end.run);
      paces_.push_back({Clock::now(), effort_here_});
    } else if (finds_disk_full(end, reason)) {
      stop_runs();  // all others would fail alike
    } else if (is_worth_a_try(end, reason, was_resumed)) {
      waiting_.push_back(end.run);
    } else {
      status_[end.run] = {.state = RunState::Failed, .reason = reason + times(losses_[end.run])};
      record_failure(options_.folder, run, status_[end.run].reason);
    }
    table_.set(end.run, status_[end.run]);
    is_changed_ = true;
  }

  // From then on nothing is a run's own failure any more.
  bool finds_disk_full(const JobEnd& end, const std::string& reason) {
    if (!disk_failure_.empty()) return true;
    if (is_stopping_ && is_interrupted(end)) return false;
    const std::string failure = disk_failure(options_.folder, reason);
    if (failure.empty()) return false;
    disk_failure_ =
        fmt::format("run {}: {}; make room: the same command goes on with the campaign", runs_[end.run].name, failure);
    return true;
  }

  // Else it has failed for good.
  bool is_worth_a_try(const JobEnd& end, const std::string& reason, bool was_resumed) {
    if (reason.find("another run writes here") != std::string::npos) {
      if (!is_stopping_) std::this_thread::sleep_for(between_tries);
      return ++tries_[end.run] < most_tries;
    }
    if (is_interrupted(end) && (is_stopping_ || status_[end.run].can_resume)) return true;
    const bool is_unseen =
        end.exit_code == 0;  // its report is not there, or not yet: a network file system may be late
    if (is_interrupted(end) || is_unseen || is_kill(end)) return ++losses_[end.run] < most_losses || is_stopping_;
    if (was_resumed) {  // its checkpoint may be of no use: once more, from the start
      fs::remove(options_.folder.run(runs_[end.run]) / "checkpoint.h5");
      status_[end.run].can_resume = false;
    }
    return was_resumed;
  }

  void write_table() {
    table_.write();
    written_ = Clock::now();
    is_changed_ = false;
  }

  double effort_of(std::size_t run) const { return options_.efforts.empty() ? 1.0 : options_.efforts[run]; }

  double effort_in(RunState state) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < status_.size(); ++i)
      if (status_[i].state == state) sum += effort_of(i);
    return sum;
  }
  // What runs is half done, on the average; what is queued is not begun.
  double effort_half_done(std::size_t queued) const {
    const double share = running_ > 0 ? 1.0 - static_cast<double>(queued) / static_cast<double>(running_) : 0.0;
    return 0.5 * share * effort_in(RunState::Running);
  }
  double effort_left(std::size_t queued) const {
    return effort_in(RunState::Waiting) + effort_in(RunState::Running) - effort_half_done(queued);
  }

  CampaignProgress progress() const {
    CampaignProgress now{.running = running_, .done_before = done_before_};
    for (const RunStatus& status : status_) {
      if (status.state == RunState::Done) ++now.done;
      if (status.state == RunState::Failed) ++now.failed;
      if (status.state == RunState::Waiting) ++now.waiting;
    }
    const EngineStatus engine = engine_.status();
    now.remark = engine.remark;
    now.running -= engine.queued;
    now.waiting += engine.queued;
    now.seconds_left = seconds_left(engine.queued);
    return now;
  }

  // By the pace of the last quarter of the runs: harder impacts often come last, and take longer than expected. 0 while
  // none is done.
  double seconds_left(std::size_t queued) const {
    constexpr std::size_t fewest = 10;
    const std::size_t done = paces_.size() - 1, last = std::min(done, std::max(fewest, done / 4));
    if (done == 0) return 0.0;
    const Pace& from = paces_[done - last];
    const bool is_all = last == done;  // nothing was half done when it began
    const double made = effort_here_ - from.effort + (is_all ? effort_half_done(queued) : 0.0);
    return std::chrono::duration<double>(Clock::now() - from.time).count() * effort_left(queued) / made;
  }

  const CampaignConfig& campaign_;
  const CampaignOptions& options_;
  Engine& engine_;
  std::vector<CampaignRun> runs_;
  std::vector<RunStatus> status_;
  std::vector<int> tries_;   // while it was held by another process
  std::vector<int> losses_;  // how often it was killed or lost
  ResultsTable table_;
  std::deque<std::size_t> waiting_{};
  std::size_t running_ = 0, done_before_ = 0;
  double effort_here_ = 0.0;  // of those done here
  std::vector<Pace> paces_{{Clock::now(), 0.0}};
  Clock::time_point written_ = Clock::now();
  bool is_changed_ = false, is_stopping_ = false;
  std::string disk_failure_{};  // why the campaign stops
};

}  // namespace

CampaignProgress run_campaign(const CampaignConfig& campaign, const CampaignOptions& options, Engine& engine,
                              const std::function<void(const CampaignProgress&)>& tell, const std::atomic<bool>& stop) {
  make_folder(options.folder.path);
  const FolderLock lock(options.folder.path, "campaign");
  prepare_folder(options.folder, options.campaign_text);
  Session session(campaign, options, engine);
  try {
    return session.run(tell, stop);
  } catch (...) {
    session.stop_runs();
    throw;
  }
}

}  // namespace knap
