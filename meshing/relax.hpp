#pragma once
#include "core/tet_mesh.hpp"
#include "meshing/shape.hpp"

namespace knap {

/// Moves the vertices of tets with a shape quality below `wanted` so that the worst tet around them improves: interior
/// vertices freely, those on a curved surface along it, those of a box not at all. Never makes the worst tet worse.
void relax_worst_tets(TetMesh& mesh, const Shape& shape, double wanted);

}  // namespace knap
