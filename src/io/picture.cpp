// VTK draws in a forked process: without a display or with a broken OpenGL it aborts or hangs instead of returning an
// error. The child only reads what the parent prepared, uses no OpenMP, and hands the PNG back through a pipe.
#include "io/picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include "core/errors.hpp"
#include "io/child_process.hpp"
#include "io/file_output.hpp"
#include "io/picture_scene.hpp"
#include "io/virtual_display.hpp"

namespace knap {
namespace {

constexpr auto packages_hint = "install xvfb and libgl1-mesa-dri: apt-get install xvfb libgl1-mesa-dri";

void check_input(const PictureInput& input) {
  const std::size_t num_tets = input.tets.size();
  if (num_tets == 0) throw RuntimeFailure("picture: there are no tets to draw");
  if (input.fragment_of_tet.size() != num_tets || input.damage_of_tet.size() != num_tets) {
    throw std::invalid_argument("picture: fragment_of_tet and damage_of_tet must have one entry a tet");
  }
  for (const Index fragment : input.fragment_of_tet) {
    if (fragment < 0 || at(fragment) >= input.fragment_mass.size()) {
      throw std::invalid_argument("picture: fragment_of_tet names a fragment without mass");
    }
  }
  const auto is_node = [&](Index node) { return node >= 0 && at(node) < input.points.size(); };
  for (const auto& tet : input.tets) {
    if (!std::all_of(tet.begin(), tet.end(), is_node)) throw std::invalid_argument("picture: a tet has no such node");
  }
  for (const auto& facet : input.broken_facets) {
    if (!std::all_of(facet.begin(), facet.end(), is_node)) {
      throw std::invalid_argument("picture: a broken facet has no such node");
    }
  }
  for (const Vec3& point : input.points) {
    if (!point.allFinite()) throw RuntimeFailure("picture: a node position is not a finite number");
  }
}

ChildResult draw_on(const std::string& display, bool software, const PictureInput& input,
                    const PictureGeometry& geometry) {
  const auto draw = [&] {
    setenv("DISPLAY", display.c_str(), 1);
    if (software) setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    return png_of_picture(input, geometry);
  };
  return run_in_child(draw, input.timeout);
}

std::string png_bytes(const PictureInput& input, const PictureGeometry& geometry) {
  std::string failures;
  if (const char* display = std::getenv("DISPLAY"); display != nullptr && *display != '\0') {
    ChildResult result = draw_on(display, false, input, geometry);
    if (result.failure.empty()) return std::move(result.output);
    failures = fmt::format("display {}: {}; ", display, result.failure);
  }
  try {
    const VirtualDisplay own(std::chrono::seconds(20));
    ChildResult result = draw_on(own.name(), true, input, geometry);
    if (result.failure.empty()) return std::move(result.output);
    failures += "virtual display: " + result.failure;
  } catch (const RuntimeFailure& failure) {
    failures += failure.what();
  }
  throw RuntimeFailure(fmt::format("picture: {} ({})", failures, packages_hint));
}

}  // namespace

void render_picture(const std::filesystem::path& png, const PictureInput& input) {
  check_input(input);
  const PictureGeometry geometry = make_picture_geometry(input);
  write_text_atomically(png, png_bytes(input, geometry));
}

}  // namespace knap
