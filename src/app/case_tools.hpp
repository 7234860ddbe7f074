#pragma once
#include <span>

#include "config/run_config.hpp"
#include "core/tet_mesh.hpp"
#include "loading/tool_options.hpp"

namespace knap {

/// The tools of a case, the wall first. A tool without a position is put where it just touches the particles, `gap` [m]
/// from them. Throws InputError for one that would miss them.
std::vector<ToolOptions> tool_options(const RunConfig& config, std::span<const TetMesh> particles, double gap);

}  // namespace knap
