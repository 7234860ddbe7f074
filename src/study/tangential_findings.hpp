#pragma once
#include "study/findings.hpp"

namespace knap {

/// The effect of the tangential velocity at fixed normal ones [m/s].
void add_tangential(Findings& findings, const Study& study, const Series& series,
                    const std::vector<double>& normal_speeds, const std::string& suffix, nlohmann::ordered_json& json);
/// How alike runs of equal normal velocity are on a wall without friction, where nothing but it can count.
void add_frictionless(Findings& findings, const Study& study, const Series& series, nlohmann::ordered_json& json);

}  // namespace knap
