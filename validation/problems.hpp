#pragma once
// The problems, each in the folder of its name: show_<name> in validation/<name>/<name>.cpp.
#include "validation/problem.hpp"

namespace knap {

// Elastic
void show_patch_test(Evidence& evidence);

// Fracture

// Contact

// Particle

}  // namespace knap
