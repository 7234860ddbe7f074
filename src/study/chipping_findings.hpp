#pragma once
#include "study/findings.hpp"

namespace knap {

/// The exponent of the chipping law above the threshold, beside the published ones; the map of classes.
void add_chipping_findings(Findings& findings, const Study& study);

}  // namespace knap
