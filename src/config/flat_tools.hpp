#pragma once
#include <string>
#include <vector>

#include "config/run_config.hpp"

namespace knap {

/// Whether one flat tool (plane, platen or the wall) looks up and another one down.
bool flat_tools_press_along_z(const RunConfig& config);

/// What keeps a case from starting at the onset of fracture: it needs one particle at rest that can break, between two
/// flat tools that face each other and come nearer at a constant velocity at last, without gravity.
void check_quasistatic(const RunConfig& config, std::vector<std::string>& found);

}  // namespace knap
