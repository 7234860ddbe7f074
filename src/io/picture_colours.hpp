#pragma once
#include <array>
#include <cstdint>

#include "core/types.hpp"

namespace knap {

using Rgb = std::array<std::uint8_t, 3>;

/// A distinct colour for each of the heaviest fragments, grey for dust (rank none).
Rgb fragment_colour(Index rank);
/// The pale colour of a fracture face of a fragment of this colour.
Rgb fracture_colour(const Rgb& fragment);
/// Damage 0 .. 1 on a perceptually uniform scale from pale yellow to dark violet; beyond the ends, their colours.
Rgb damage_colour(double damage);
/// a + share * (b - a).
Rgb mixed(const Rgb& a, const Rgb& b, double share);

}  // namespace knap
