#pragma once
#include <compare>

#include "core/types.hpp"

namespace knap {

/// Two fragments whose cracked faces still meet as twins at an original vertex: their tets there do not touch, the
/// crack's own impulses keep them apart.
struct FragmentJoint {
  Index vertex = none;
  std::array<Index, 2> fragments{none, none};  ///< ascending

  auto operator<=>(const FragmentJoint&) const = default;
};

}  // namespace knap
