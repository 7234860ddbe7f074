#pragma once
#include "core/tet_mesh.hpp"

namespace knap {

/// Whether a tet of one mesh overlaps one of the other.
bool overlap(const TetMesh& a, const TetMesh& b);

}  // namespace knap
