#pragma once
#include "study/findings.hpp"

namespace knap {

/// Size distributions of the steepest angle with the resolution floor, their laws, t_n and shapes over speed.
void add_size_findings(Findings& findings, const Study& study);

/// Means over the runs of a condition: the mass fraction that passes each sieve over the particle's diameter.
std::vector<double> mean_passing(const Study& study, const std::vector<std::size_t>& runs,
                                 const std::vector<double>& sieves_over_diameter);
/// The largest element size of the runs over their diameter.
double resolution_floor(const Study& study, const std::vector<std::size_t>& runs);

}  // namespace knap
