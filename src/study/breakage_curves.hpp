#pragma once
#include "study/findings.hpp"

namespace knap {

/// Breakage over speed and angle, and the speeds at which the steepest angle's mean reaches some levels.
void add_breakage_curves(Findings& findings, const Study& study, const Series& series, const std::string& suffix,
                         nlohmann::ordered_json& json);

}  // namespace knap
