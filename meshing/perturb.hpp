#pragma once
#include "core/tet_mesh.hpp"

namespace knap {

/// Moves every interior vertex to a random place within `fraction` of its mean edge,.
/// A move that would leave a tet with a shape quality below 0.1 is not made. The surface stays.
void perturb_interior(TetMesh& mesh, double fraction, std::int64_t seed);

}  // namespace knap
