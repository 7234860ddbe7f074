#pragma once
#include <array>
#include <string>

#include "io/fragment_surfaces.hpp"

namespace knap {

/// Surfaces of fragments for the page: positions on a grid of 65536 steps a side, bytes ordered to compress well, zlib.
/// The bytes inside, little endian, each array split into planes (all lowest bytes first): u32 points and u32 triangles
/// of each fragment; f32 share of the volume; f32 centre x, y, z [m]; u16 x, then y, z: each less the one before; u32
/// corners: how far each is below the first point not used yet; u8 is_fracture.
struct PackedSurfaces {
  std::string bytes;
  std::array<double, 3> origin{};  ///< of the grid [m]
  double step = 0.0;               ///< [m]
  Index num_fragments = 0, num_points = 0, num_triangles = 0;
};

PackedSurfaces packed(const FragmentSurfaces& surfaces);

}  // namespace knap
