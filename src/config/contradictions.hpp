#pragma once
#include <string>
#include <vector>

#include "config/run_config.hpp"

namespace knap {

/// Mistakes that only show when several keys are seen together, one message each, beginning with the key.
std::vector<std::string> contradictions(const RunConfig& config);

}  // namespace knap
