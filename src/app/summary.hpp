#pragma once
#include <string>

#include "app/run_outcome.hpp"

namespace knap {

/// The result of a run as a table for the terminal. `utf8`: bars of blocks, else of ASCII.
std::string summary(const Simulation& s, const RunOutcome& outcome, const std::string& folder, bool utf8);

}  // namespace knap
