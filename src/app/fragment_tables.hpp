#pragma once
#include <filesystem>

#include "app/run_outcome.hpp"

namespace knap {

/// fragments.csv: a row for each piece by the damage label.
void write_fragments(const std::filesystem::path& path, const RunOutcome& outcome);

/// size_distribution.csv: mass and number finer than each sieve size, same label.
void write_size_distribution(const std::filesystem::path& path, const RunOutcome& outcome, const Simulation& s);

}  // namespace knap
