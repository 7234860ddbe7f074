#pragma once
#include <string>
#include <vector>

#include "campaign/campaign_folder.hpp"

namespace knap {

/// results.csv, a row a run: its name, state, why it failed, the keys that vary in SI, and every number of its report
/// by its way in report.json, "breakage.t10". A run that is not done has empty cells there.
class ResultsTable {
 public:
  ResultsTable(CampaignFolder folder, const CampaignConfig& campaign, std::vector<CampaignRun> runs);

  /// Takes over how a run stands; reads its report if it is done.
  void set(std::size_t run, const RunStatus& status);
  /// Replaces the file in one step.
  void write() const;

 private:
  using Cells = std::vector<std::pair<std::string, std::string>>;  // column, cell

  CampaignFolder folder_;
  std::vector<CampaignRun> runs_;
  std::vector<Cells> parameters_;  // by run
  std::vector<RunStatus> status_;
  std::vector<Cells> numbers_;
};

}  // namespace knap
