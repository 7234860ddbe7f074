#pragma once
#include <chrono>
#include <filesystem>
#include <limits>
#include <string>

#include "core/types.hpp"

namespace knap {

/// A tool to be seen behind and around the particle.
struct PictureTool {
  std::vector<Vec3> points;  ///< [m]
  std::vector<std::array<Index, 3>> triangles;
};

/// What the picture of a particle shows.
struct PictureInput {
  std::vector<Vec3> points;  ///< deformed nodes, apart where cracks have parted them [m]
  std::vector<TetCorners> tets;
  std::vector<std::array<Index, 3>> broken_facets;  ///< nodes of the broken facets, both sides of each
  std::vector<Index> fragment_of_tet;
  std::vector<double> fragment_mass;                              ///< [kg]
  std::vector<double> damage_of_tet;                              ///< 0 .. 1
  double wall_height = std::numeric_limits<double>::quiet_NaN();  ///< z of the wall [m]; nan = no wall
  std::vector<PictureTool> tools;                                 ///< grey and half transparent, near the particle
  double dust_share = 1e-3;  ///< fragments of less than this share of the mass are dust: grey, left out when exploded
  std::string title;         ///< UTF-8, as all texts
  std::string subtitle;
  std::chrono::seconds timeout{60};  ///< for each attempt to draw
};

/// Draws a PNG of 2400 x 900 pixels: the outside, a cut through the centre coloured by damage, the fragments apart.
/// Needs no display: uses $DISPLAY if that works, else a virtual one of its own. Throws RuntimeFailure, never hangs or
/// crashes; std::invalid_argument for arrays that do not fit together.
void render_picture(const std::filesystem::path& png, const PictureInput& input);

}  // namespace knap
