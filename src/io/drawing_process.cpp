// VTK draws in a forked process: without a display or with a broken OpenGL it aborts or hangs instead of returning an
// error. The child only reads what the parent prepared, uses no OpenMP, and hands the PNG back through a pipe.
#include "io/drawing_process.hpp"

#include <fmt/format.h>

#include <cstdlib>

#include "core/errors.hpp"
#include "io/child_process.hpp"
#include "io/virtual_display.hpp"

namespace knap {
namespace {

constexpr auto packages_hint = "install xvfb and libgl1-mesa-dri: apt-get install xvfb libgl1-mesa-dri";

ChildResult draw_on(const std::string& display, bool software, const std::function<std::string()>& draw,
                    std::chrono::seconds timeout) {
  const auto drawn = [&] {
    setenv("DISPLAY", display.c_str(), 1);
    if (software) setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    return draw();
  };
  return run_in_child(drawn, timeout);
}

}  // namespace

std::string png_drawn(const std::function<std::string()>& draw, std::chrono::seconds timeout) {
  std::string failures;
  if (const char* display = std::getenv("DISPLAY"); display != nullptr && *display != '\0') {
    ChildResult result = draw_on(display, false, draw, timeout);
    if (result.failure.empty()) return std::move(result.output);
    failures = fmt::format("display {}: {}; ", display, result.failure);
  }
  try {
    const VirtualDisplay own(std::chrono::seconds(20));
    ChildResult result = draw_on(own.name(), true, draw, timeout);
    if (result.failure.empty()) return std::move(result.output);
    failures += "virtual display: " + result.failure;
  } catch (const RuntimeFailure& failure) {
    failures += failure.what();
  }
  throw RuntimeFailure(fmt::format("picture: {} ({})", failures, packages_hint));
}

}  // namespace knap
