#pragma once
#include "study/findings.hpp"

namespace knap {

/// Vogel-Peukert, Shi-Kojovic, Tavares and Weibull in speed, of the impacts at the steepest angle; exported for a
/// population balance. A particle is broken that has lost the part `broken` of its mass. Throws RuntimeFailure if the
/// exported matrices do not conserve mass.
void add_breakage_findings(Findings& findings, const Study& study, double broken);

}  // namespace knap
