#pragma once
#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "campaign/campaign_folder.hpp"
#include "campaign/engine.hpp"

namespace knap {

struct CampaignOptions {
  CampaignFolder folder;
  std::string campaign_text;      ///< of the campaign file, kept in the folder
  std::filesystem::path program;  ///< knap
  bool retries_failed = false;
  std::vector<double> efforts{};  ///< what each run is expected to take, for the time left; empty = all alike
};

/// How a campaign stands, for its live table.
struct CampaignProgress {
  std::size_t done = 0, running = 0, failed = 0, waiting = 0;
  std::size_t done_before = 0;  ///< of those done, by an earlier session
  double seconds_left = 0.0;    ///< 0 = not known
  std::string remark{};         ///< what keeps the engine; "" = nothing

  std::size_t total() const { return done + running + failed + waiting; }
};

/// Runs what is not done yet and grows results.csv; what fails is recorded and the rest goes on. Returns how it stands
/// at the end, or when `stop` has become true and all runs have stopped. Throws InputError if the folder holds another
/// campaign, or another process works on it; RuntimeFailure if the disk is full, for the campaign or a run of it: then
/// nothing is recorded as failed, and all runs are stopped.
CampaignProgress run_campaign(const CampaignConfig& campaign, const CampaignOptions& options, Engine& engine,
                              const std::function<void(const CampaignProgress&)>& tell, const std::atomic<bool>& stop);

}  // namespace knap
