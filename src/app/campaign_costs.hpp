#pragma once
#include <vector>

#include "config/campaign_config.hpp"

namespace knap {

/// What a run is expected to cost.
struct ExpectedCost {
  double tets = 0.0;
  double seconds = 0.0;  ///< of one core
  double bytes = 0.0;    ///< of memory
  int threads = 0;       ///< 0 = all processors
};

/// What the runs of a campaign will cost. Every case is checked before the first one runs, so that nothing fails in the
/// middle of the night. Throws InputError with a line for each mistake and the runs it is in; two runs that would be
/// the same are one, since they would be taken for a repeat without scatter.
std::vector<ExpectedCost> checked_costs(const CampaignConfig& campaign, const std::vector<CampaignRun>& runs);

}  // namespace knap
