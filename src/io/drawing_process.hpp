#pragma once
#include <chrono>
#include <functional>
#include <string>

namespace knap {

/// Runs `draw`, which draws on the display $DISPLAY and returns a PNG's bytes, in a process of its own: on the user's
/// display if that works, else on a virtual one. Throws RuntimeFailure; never hangs longer than `timeout` an attempt.
std::string png_drawn(const std::function<std::string()>& draw, std::chrono::seconds timeout);

}  // namespace knap
