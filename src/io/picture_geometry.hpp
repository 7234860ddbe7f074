#pragma once
#include "io/picture.hpp"

namespace knap {

/// What is drawn, before any drawing.
struct PictureGeometry {
  std::vector<std::array<Index, 3>> surface;      ///< facets of one tet only, right-hand normal outwards
  std::vector<Index> tet_of_surface;              ///< the tet behind each
  std::vector<std::uint8_t> is_crack_face;        ///< whether each is a broken facet, not the particle's skin
  std::vector<std::array<Index, 2>> crack_lines;  ///< edges where cracks meet the skin
  std::vector<Index> fragment_rank;               ///< 0 = heaviest; none = dust
  std::vector<Vec3> fragment_centre;              ///< centroid [m]
  Index num_main = 0;                             ///< the heaviest fragments that make most of the mass
  Vec3 centre = Vec3::Zero();                     ///< of the fragments that are no dust [m]
};

PictureGeometry make_picture_geometry(const PictureInput& input);

/// The nodes with each fragment moved away from the centre by `factor` times its centre's distance from it [m].
std::vector<Vec3> exploded_points(const PictureInput& input, const PictureGeometry& geometry, double factor);

/// Those of `points` (one for each node) that belong to the heaviest fragments, together most of the mass: what a view
/// must show, while small pieces may fly out of it [m].
std::vector<Vec3> main_points(const std::vector<Vec3>& points, const PictureInput& input,
                              const PictureGeometry& geometry);

}  // namespace knap
