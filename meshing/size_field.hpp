#pragma once
#include "meshing/tetrahedralise.hpp"

namespace knap {

/// Makes the sizes of the options the background field of the current gmsh model. `modulated` adds a wave of 3 % whose
/// direction comes from the seed: this is how a shape that cannot be rotated gets another mesh.
void add_size_field(const TetrahedraliseOptions& options, bool modulated);

}  // namespace knap
