#pragma once
#include <array>
#include <filesystem>
#include <span>
#include <vector>

#include "core/types.hpp"

namespace knap {

/// The pieces of a particle by what one sees of them; fragment f owns the points from first_point[f] to
/// first_point[f + 1] and the triangles from first_triangle[f] to first_triangle[f + 1].
struct FragmentSurfaces {
  std::vector<std::array<float, 3>> points;     ///< deformed [m]
  std::vector<std::array<Index, 3>> triangles;  ///< into points, right-hand normal outwards
  std::vector<std::uint8_t> is_fracture;        ///< of each triangle: made by a crack, not the particle's skin
  std::vector<Index> first_point, first_triangle;
  std::vector<Vec3> centre;    ///< of volume, of each fragment [m]
  std::vector<double> volume;  ///< undeformed, of each fragment [m3]

  Index num_fragments() const { return to_index(volume.size()); }
};

/// What a frame tells of the pieces.
struct FrameTets {
  std::span<const Vec3> points;     ///< deformed nodes, apart where cracks opened [m]
  std::span<const Vec3> reference;  ///< where they were before; empty = not known [m]
  std::span<const TetCorners> tets;
  std::span<const Index> fragment;  ///< of each tet, by rank: 0, 1, ...
};

/// A facet is inner where two tets of one fragment have its three nodes. Without `reference`, a facet counts as
/// fracture only where its nodes are still in common, and volumes are the deformed ones. std::invalid_argument for
/// arrays that do not fit together.
FragmentSurfaces make_fragment_surfaces(const FrameTets& frame);

/// The pieces in a frame of a run, by its array `fragment` (damage label). Throws InputError naming the file if it
/// cannot be read or is none.
FragmentSurfaces read_fragment_surfaces(const std::filesystem::path& vtu);

}  // namespace knap
