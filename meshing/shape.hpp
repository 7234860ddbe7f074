#pragma once
#include <variant>

#include "core/types.hpp"

namespace knap {

/// Shapes are centred at the origin with their axes along x, y, z.
struct Sphere {
  double diameter;  ///< [m]
};
struct Ellipsoid {
  Vec3 diameters;  ///< along x, y, z [m]
};
struct Box {
  Vec3 lengths;  ///< along x, y, z [m]
};
/// The geometry of a particle before meshing.
using Shape = std::variant<Sphere, Ellipsoid, Box>;

/// Volume [m3] of the exact shape.
double volume(const Shape& shape);
/// Lengths [m] of the bounding box along x, y, z.
Vec3 extent(const Shape& shape);
/// The same shape with every length multiplied by `factor`.
Shape scaled(const Shape& shape, double factor);
/// The surface point that a surface vertex of a mesh stands for: removes round-off and the chord error of the mesher.
Vec3 snapped_to_surface(const Shape& shape, const Vec3& x);

}  // namespace knap
