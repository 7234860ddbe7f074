#pragma once
#include "core/tet_stress.hpp"

namespace knap {

/// At least the magnitude of facet_traction for any normal [Pa]; cheap, to skip the facets that cannot fail.
inline double facet_traction_bound(const TetStress& minus, const TetStress& plus) {
  return 0.5 * (minus.norm + plus.norm);
}

}  // namespace knap
