#pragma once
#include <string>

namespace knap {

/// A granule of 2 mm on a wall under a platen that comes down.
inline std::string pressed_case(const std::string& further_sections = "", const std::string& further_tool_keys = "") {
  return R"(
[particle]
diameter = "2 mm"
[material]
preset = "zeolite_4ak"
[impact]
wall = true
)" + further_sections +
         R"(
[[tool]]
name = "upper"
type = "platen"
radius = "2 mm"
normal = [0, 0, -1]
motion = "velocity"
velocity = [0, 0, "-8 m/s"]
)" + further_tool_keys;
}

/// Too coarse and too fast to mean anything: breaks within a second or two.
inline std::string coarse_pressed_case(const std::string& further_sections = "") {
  return pressed_case(further_sections + R"(
[mesh]
element_size = "0.35 mm"
[fracture]
allow_unresolved = true
[output]
frames = 2
picture = false
)",
                      "stop_at_force_drop = 0.5\n");
}

/// Starts the run at the onset of fracture.
inline constexpr const char* from_the_onset = "[quasistatic]\nenabled = true\n";

}  // namespace knap
