#pragma once
#include <filesystem>

#include "app/run_outcome.hpp"

namespace knap {

/// Draws the final state, pieces by the damage label. Throws RuntimeFailure where it cannot be drawn.
void draw_run(const std::filesystem::path& png, const Simulation& s, const RunOutcome& outcome);

}  // namespace knap
