#include "contact/tool_shape.hpp"

#include <cmath>

namespace knap {
namespace {

// Of a solid cylinder about z from -half_length to half_length.
SurfaceDistance cylinder_distance(double radius, double half_length, const Vec3& point) {
  const double r = std::hypot(point.x(), point.y());
  const Vec3 radial = r > 0.0 ? Vec3(point.x() / r, point.y() / r, 0.0) : Vec3::UnitX();
  const Vec3 axial(0.0, 0.0, std::copysign(1.0, point.z()));
  const double beside = r - radius, beyond = std::abs(point.z()) - half_length;
  if (beside <= 0.0 || beyond <= 0.0) {
    if (beside > beyond) return {beside, radial};
    return {beyond, axial};
  }
  const double gap = std::hypot(beside, beyond);
  return {gap, (beside * radial + beyond * axial) / gap};
}

ShapeBox cylinder_box(double radius, double low, double high) {
  return {Vec3(-radius, -radius, low), Vec3(radius, radius, high)};
}

}  // namespace

SurfaceDistance surface_distance(const HalfSpace&, const Vec3& point) { return {point.z(), Vec3::UnitZ()}; }

SurfaceDistance surface_distance(const DiscPlaten& shape, const Vec3& point) {
  const double half = 0.5 * shape.thickness;
  return cylinder_distance(shape.radius, half, point + half * Vec3::UnitZ());
}

SurfaceDistance surface_distance(const BallTool& shape, const Vec3& point) {
  const double r = point.norm();
  return {r - shape.radius, r > 0.0 ? Vec3(point / r) : Vec3(Vec3::UnitZ())};
}

SurfaceDistance surface_distance(const CylinderTool& shape, const Vec3& point) {
  return cylinder_distance(shape.radius, 0.5 * shape.length, point);
}

ShapeBox bounding_box(const HalfSpace&) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return {Vec3::Constant(-infinity), Vec3(infinity, infinity, 0.0)};
}

ShapeBox bounding_box(const DiscPlaten& shape) { return cylinder_box(shape.radius, -shape.thickness, 0.0); }

ShapeBox bounding_box(const BallTool& shape) { return {Vec3::Constant(-shape.radius), Vec3::Constant(shape.radius)}; }

ShapeBox bounding_box(const CylinderTool& shape) {
  return cylinder_box(shape.radius, -0.5 * shape.length, 0.5 * shape.length);
}

}  // namespace knap
