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

std::vector<Vec3> cylinder_points(double radius, double low, double high) {
  return {Vec3(0, 0, 0.5 * (low + high)), Vec3(0, 0, low), Vec3(0, 0, high), Vec3(radius, 0, low),
          Vec3(radius, 0, high)};
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

ShapeBox bounding_box(const SurfaceTool& shape) {
  const Vec3 grown = Vec3::Constant(0.5 * shape.thickness);
  const TreeBox& box = shape.surface.tree.front();
  return {box.low - grown, box.high + grown};
}

std::vector<Vec3> points_inside(const HalfSpace&) { return {}; }

std::vector<Vec3> points_inside(const DiscPlaten& shape) {
  return cylinder_points(shape.radius, -shape.thickness, 0.0);
}

std::vector<Vec3> points_inside(const BallTool&) { return {Vec3::Zero()}; }

std::vector<Vec3> points_inside(const CylinderTool& shape) {
  return cylinder_points(shape.radius, -0.5 * shape.length, 0.5 * shape.length);
}

SurfaceDistance surface_distance(const SurfaceTool& shape, const Vec3& point) {
  // Nearer than this to an edge or corner, over the size of the surface, the direction to it would be round-off.
  constexpr double touching = 1e-10;
  const TriangleSurface& surface = shape.surface;
  const SurfacePoint near = closest_point(surface, point);
  const Vec3 away = point - near.point;
  const double side = near.normal.dot(away) < 0.0 ? -1.0 : 1.0;
  const double outside = surface.closed ? side : 1.0;  // -1 = inside the solid
  const double gap = outside * (near.on_face ? std::abs(near.normal.dot(away)) : near.distance) - 0.5 * shape.thickness;
  if (near.on_face) return {gap, side * outside * near.normal};
  const double size = (surface.tree.front().high - surface.tree.front().low).norm();
  if (near.distance > touching * size) return {gap, outside / near.distance * away};
  return {gap, near.normal.norm() > 0.0 ? near.normal.normalized() : Vec3(Vec3::UnitZ())};
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

std::vector<Vec3> points_inside(const SurfaceTool& shape) { return shape.surface.vertices; }

}  // namespace knap
