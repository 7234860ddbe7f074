#pragma once
#include "core/tet_mesh.hpp"

namespace knap {

/// The same mesh with vertices and tets (by centroid) sorted along a Morton curve of 2^21 cells a side, which keeps
/// what is near in space near in memory. Unused vertices are dropped; ties keep their order; corner order within a tet
/// stays.
TetMesh morton_ordered(const TetMesh& mesh);

}  // namespace knap
