#pragma once
#include "contact/tool.hpp"

namespace knap {

/// A surface to look at.
struct DrawnSurface {
  std::vector<Vec3> points;                     ///< [m]
  std::vector<std::array<Index, 3>> triangles;  ///< right-hand normals out of the tool
};

/// The surface of a tool where it is now; of a half space a disc of `radius` [m] around the point nearest to `centre`.
DrawnSurface tool_surface(const Tool& tool, const Vec3& centre, double radius);

}  // namespace knap
