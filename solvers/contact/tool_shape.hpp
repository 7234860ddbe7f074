#pragma once
// Shapes of tools, each in its own frame; where a tool stands and how it moves is in tool.hpp.
#include <limits>
#include <variant>

#include "contact/triangle_surface.hpp"

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

/// Triangles, of an STL file say. Closed: the solid inside. Open: a shell of that thickness about them, rounded at its
/// rim, that stops the particle from both sides. A thickness given to a closed surface grows the solid by half of it.
struct SurfaceTool {
  TriangleSurface surface;
  double thickness = 0.0;  ///< [m]
};

using ToolShape = std::variant<HalfSpace, DiscPlaten, BallTool, CylinderTool, SurfaceTool>;

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
SurfaceDistance surface_distance(const SurfaceTool& shape, const Vec3& point);

/// A box in the shape's frame around its solid [m]; infinite where the solid is.
struct ShapeBox {
  Vec3 low, high;
};
ShapeBox bounding_box(const HalfSpace& shape);
ShapeBox bounding_box(const DiscPlaten& shape);
ShapeBox bounding_box(const BallTool& shape);
ShapeBox bounding_box(const CylinderTool& shape);
ShapeBox bounding_box(const SurfaceTool& shape);

/// A few points of the shape's solid, its corners and middle: a particle that holds the whole tool has them inside.
std::vector<Vec3> points_inside(const HalfSpace& shape);
std::vector<Vec3> points_inside(const DiscPlaten& shape);
std::vector<Vec3> points_inside(const BallTool& shape);
std::vector<Vec3> points_inside(const CylinderTool& shape);
std::vector<Vec3> points_inside(const SurfaceTool& shape);

}  // namespace knap
