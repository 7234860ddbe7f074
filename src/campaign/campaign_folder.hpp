#pragma once
#include <filesystem>
#include <string>

#include "campaign/engine.hpp"
#include "config/campaign_config.hpp"

namespace knap {

/// The names of a campaign's files.
struct CampaignFolder {
  std::filesystem::path path;
  std::filesystem::path campaign() const { return path / "campaign.toml"; }
  std::filesystem::path results() const { return path / "results.csv"; }
  std::filesystem::path runs() const { return path / "runs"; }
  std::filesystem::path run(const CampaignRun& run) const { return runs() / run.name; }
  std::filesystem::path log(const CampaignRun& run) const { return path / "logs" / (run.name + ".txt"); }
  std::filesystem::path failure(const CampaignRun& run) const { return path / "failures" / (run.name + ".txt"); }
};

enum class RunState { Waiting, Running, Done, Failed };
/// "waiting", "running", "done", "failed".
std::string_view name(RunState state);

/// How a run stands by what lies in the folder.
struct RunStatus {
  RunState state = RunState::Waiting;
  bool can_resume = false;  ///< it was stopped, and left a checkpoint
  std::string reason{};     ///< why it failed
};

/// Throws InputError where the run's folder holds one of another case: the campaign or its base has changed since.
RunStatus status_of(const CampaignFolder& folder, const CampaignConfig& campaign, const CampaignRun& run);

/// What a finished run has cost.
struct RunCost {
  double core_seconds = 0.0;
  double bytes = 0.0;  ///< on the disk
};
RunCost cost_of(const CampaignFolder& folder, const CampaignRun& run);

/// Keeps the reason why a run failed, so that it is not tried again; or forgets it.
void record_failure(const CampaignFolder& folder, const CampaignRun& run, const std::string& reason);
void forget_failure(const CampaignFolder& folder, const CampaignRun& run);

/// What a run that ended so said last: its last line that begins with "error: ", else how it ended.
std::string reason_of(const CampaignFolder& folder, const CampaignRun& run, const JobEnd& end);
/// Why the disk takes no more, if a run that failed for this reason had no room, or there is none in the folder now;
/// else
/// "".
std::string disk_failure(const CampaignFolder& folder, const std::string& reason);

}  // namespace knap
