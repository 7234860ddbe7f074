#include "io/picture.hpp"

#include <algorithm>
#include <stdexcept>

#include "core/errors.hpp"
#include "io/drawing_process.hpp"
#include "io/file_output.hpp"
#include "io/picture_scene.hpp"

namespace knap {
namespace {

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
  for (const PictureTool& tool : input.tools) {
    const auto is_point = [&](Index point) { return point >= 0 && at(point) < tool.points.size(); };
    for (const auto& triangle : tool.triangles) {
      if (!std::all_of(triangle.begin(), triangle.end(), is_point)) {
        throw std::invalid_argument("picture: a tool has no such point");
      }
    }
  }
  for (const Vec3& point : input.points) {
    if (!point.allFinite()) throw RuntimeFailure("picture: a node position is not a finite number");
  }
}

}  // namespace

void render_picture(const std::filesystem::path& png, const PictureInput& input) {
  check_input(input);
  const PictureGeometry geometry = make_picture_geometry(input);
  write_text_atomically(png, png_drawn([&] { return png_of_picture(input, geometry); }, input.timeout));
}

}  // namespace knap
