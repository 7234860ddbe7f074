#pragma once
#include <string>

#include "contact/triangle_surface.hpp"

namespace knap {

/// A surface from loose triangles. What is safe is repaired: corners of the same place are joined, triangles without
/// extent and doubles dropped, flipped ones turned, closed surfaces turned outwards. Everything else is refused with
/// the reason and the number of the triangle (from 1): more than two triangles at an edge, a surface with one side
/// only, parts that cut each other, sizes that make no sense. Throws InputError; `name` begins the message.
TriangleSurface repaired_surface(const std::vector<std::array<Vec3, 3>>& triangles, const std::string& name);

}  // namespace knap
