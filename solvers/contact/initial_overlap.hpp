#pragma once
#include <optional>
#include <span>

#include "core/types.hpp"

namespace knap {

/// Two tets of different particles that overlap by more than a millionth of their size, or nothing: faces may touch.
std::optional<std::array<Index, 2>> overlapping_tets(std::span<const TetCorners> tets, std::span<const Vec4> x,
                                                     std::span<const Index> particle_of_tet);

}  // namespace knap
