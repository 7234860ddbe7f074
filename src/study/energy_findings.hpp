#pragma once
#include "study/findings.hpp"

namespace knap {

/// Where the energy went, over the speed, at the steepest angle.
void add_energy_findings(Findings& findings, const Study& study);

}  // namespace knap
