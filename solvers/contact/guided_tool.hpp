#pragma once
#include "contact/tool_landing.hpp"

namespace knap {

/// Finds the speed of a guided tool at which it and the nodes that land on it end the step in touch, and puts those
/// landings in the place of the ones found at its free speed. The faster it goes, the larger the impulses against it:
/// there is one such speed, and no node lands that would not at the free speed.
void meet_guided_tool(Tool& tool, Index number, const NodalState& nodes, const ToolStep& step, ToolLandings& landings);

}  // namespace knap
