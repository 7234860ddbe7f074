#pragma once
// Shapes of tools, each in its own frame; where a tool stands and how it moves is in tool.hpp.
#include <limits>
#include <variant>

#include "core/types.hpp"

namespace knap {

/// Solid below z = 0.
struct HalfSpace {};

/// A flat solid disc about the z axis, its face in z = 0, solid below.
struct DiscPlaten {
  double radius = 0.0;     ///< [m]
  double thickness = 0.0;  ///< [m]
};

/// A solid ball about the origin.
struct BallTool {
  double radius = 0.0;  ///< [m]
};

/// A solid cylinder about the z axis, from -length/2 to length/2, with flat ends.
struct CylinderTool {
  double radius = 0.0;  ///< [m]
  double length = 0.0;  ///< [m]
};

using ToolShape = std::variant<HalfSpace, DiscPlaten, BallTool, CylinderTool>;

/// Distance of a point to the surface of a shape.
struct SurfaceDistance {
  double gap = std::numeric_limits<double>::infinity();  ///< [m], negative inside
  Vec3 normal = Vec3::UnitZ();                           ///< unit, from the nearest point of the surface outwards
};

/// Exact distance of a point in the shape's frame.
SurfaceDistance surface_distance(const HalfSpace& shape, const Vec3& point);
SurfaceDistance surface_distance(const DiscPlaten& shape, const Vec3& point);
SurfaceDistance surface_distance(const BallTool& shape, const Vec3& point);
SurfaceDistance surface_distance(const CylinderTool& shape, const Vec3& point);

/// A box in the shape's frame around its solid [m]; infinite where the solid is.
struct ShapeBox {
  Vec3 low, high;
};
ShapeBox bounding_box(const HalfSpace& shape);
ShapeBox bounding_box(const DiscPlaten& shape);
ShapeBox bounding_box(const BallTool& shape);
ShapeBox bounding_box(const CylinderTool& shape);

}  // namespace knap
