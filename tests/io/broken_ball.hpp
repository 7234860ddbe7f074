#pragma once
#include "io/picture.hpp"

namespace knap {

/// A ball of 6 * n^3 tets that hit the wall with its lower pole: six wedges, a crushed cone of small pieces under them,
/// slightly moved apart; damaged towards the cracks.
PictureInput broken_ball(Index n);

}  // namespace knap
