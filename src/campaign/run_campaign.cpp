#include "campaign/run_campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <thread>

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
        started_(runs_.size()),
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
    bool is_stopping = false;
    while (running_ > 0 || (!waiting_.empty() && !is_stopping)) {
      if (stop && !is_stopping) engine_.stop(), is_stopping = true;
      while (!is_stopping && !waiting_.empty() && engine_.free_slots() > 0) start_next();
      tell(progress());
      for (const JobEnd& end : engine_.wait(patience)) settle(end, is_stopping);
      if (is_changed_ && Clock::now() - written_ > between_tables) write_table();
    }
    write_table();
    tell(progress());
    return progress();
  }

 private:
  void start_next() {
    const std::size_t i = waiting_.front();
    waiting_.pop_front();
    const CampaignRun& run = runs_[i];
    std::vector<std::string> command{options_.program.string(), "run", campaign_.base.string()};
    for (const std::string& text : overrides_of(campaign_, run)) command.insert(command.end(), {"--set", text});
    command.insert(command.end(), {"--out", options_.folder.run(run).string(), "--quiet",
                                   status_[i].can_resume ? "--resume" : "--overwrite"});
    engine_.start({i, std::move(command), options_.folder.log(run)});
    status_[i].state = RunState::Running;
    started_[i] = Clock::now();
    ++running_;
  }

  void settle(const JobEnd& end, bool is_stopping) {
    const CampaignRun& run = runs_[end.run];
    --running_;
    ++tries_[end.run];
    const bool was_resumed = status_[end.run].can_resume;
    const std::string reason = reason_of(options_.folder, run, end.exit_code);
    const bool is_held = reason.find("another run writes here") != std::string::npos;
    status_[end.run] = status_of(options_.folder, campaign_, run);
    if (status_[end.run].state == RunState::Done) {
      seconds_ += std::chrono::duration<double>(Clock::now() - started_[end.run]).count();
      ++timed_;
    } else if (end.exit_code == static_cast<int>(ExitCode::Interrupted)) {
      if (!is_stopping) waiting_.push_back(end.run);
    } else if (was_resumed && !is_held) {  // its checkpoint may be of no use: once more, from the start
      fs::remove(options_.folder.run(run) / "checkpoint.h5");
      status_[end.run].can_resume = false;
      waiting_.push_back(end.run);
    } else if (is_held && tries_[end.run] < most_tries) {
      std::this_thread::sleep_for(between_tries);
      waiting_.push_back(end.run);
    } else {
      record_failure(options_.folder, run, reason);
      status_[end.run] = {.state = RunState::Failed, .reason = reason};
    }
    table_.set(end.run, status_[end.run]);
    is_changed_ = true;
  }

  void write_table() {
    table_.write();
    written_ = Clock::now();
    is_changed_ = false;
  }

  CampaignProgress progress() const {
    CampaignProgress now{.running = running_, .done_before = done_before_};
    for (const RunStatus& status : status_) {
      if (status.state == RunState::Done) ++now.done;
      if (status.state == RunState::Failed) ++now.failed;
      if (status.state == RunState::Waiting) ++now.waiting;
    }
    const double slots = static_cast<double>(running_ + engine_.free_slots());
    if (timed_ > 0)
      now.seconds_left = seconds_ / static_cast<double>(timed_) *
                         (static_cast<double>(now.waiting) + 0.5 * static_cast<double>(running_)) /
                         std::max(1.0, slots);
    return now;
  }

  const CampaignConfig& campaign_;
  const CampaignOptions& options_;
  Engine& engine_;
  std::vector<CampaignRun> runs_;
  std::vector<RunStatus> status_;
  std::vector<int> tries_;
  std::vector<Clock::time_point> started_;
  ResultsTable table_;
  std::deque<std::size_t> waiting_{};
  std::size_t running_ = 0, done_before_ = 0, timed_ = 0;
  double seconds_ = 0.0;  // that the timed runs took
  Clock::time_point written_ = Clock::now();
  bool is_changed_ = false;
};

}  // namespace

CampaignProgress run_campaign(const CampaignConfig& campaign, const CampaignOptions& options, Engine& engine,
                              const std::function<void(const CampaignProgress&)>& tell, const std::atomic<bool>& stop) {
  make_folder(options.folder.path);
  const FolderLock lock(options.folder.path, "campaign");
  prepare_folder(options.folder, options.campaign_text);
  return Session(campaign, options, engine).run(tell, stop);
}

}  // namespace knap
