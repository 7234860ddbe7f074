#pragma once
#include "study/findings.hpp"

namespace knap {

/// Breakage over speed and angle; the equivalent velocity and its verdict; the effect of the tangential velocity at
/// fixed normal ones [m/s]; the identity of walls without friction.
void add_velocity_findings(Findings& findings, const Study& study, const std::vector<double>& normal_speeds,
                           int collapse_samples);

}  // namespace knap
