#pragma once
#include "study/findings.hpp"

namespace knap {

/// The equivalent velocity against the normal component alone, for a wall with friction; `samples` of the bootstrap.
void add_collapse(Findings& findings, const Study& study, const Series& series, const std::string& suffix, int samples,
                  nlohmann::ordered_json& json);
/// One a for walls of several frictions, each with its own mu; nothing where there is one friction.
void add_known_friction(Findings& findings, const Study& study, int samples);

}  // namespace knap
