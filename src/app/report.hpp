#pragma once
#include <filesystem>

#include "app/run_outcome.hpp"

namespace knap {

/// Writes report.json in SI units, listed under "units". Numbers that are not known are null.
void write_report(const std::filesystem::path& path, const Simulation& s, const RunOutcome& outcome);

}  // namespace knap
