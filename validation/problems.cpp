#include "validation/problems.hpp"

#include <array>

namespace knap {

std::span<const Problem> problems() {
  static const std::array list{
      // Elastic
      Problem{"patch_test", "elastic", "the law at a homogeneous deformation: exact", show_patch_test},
      // Fracture
      // Contact
      // Particle
  };
  return list;
}

}  // namespace knap
