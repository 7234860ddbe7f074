#include "observers/tool_surface.hpp"

#include <cmath>
#include <numbers>

namespace knap {
namespace {

constexpr Index num_spokes = 64;
constexpr Index num_rings = 32;  // of a ball, from pole to pole

void add_ring(DrawnSurface& surface, double radius, double z) {
  for (Index spoke = 0; spoke < num_spokes; ++spoke) {
    const double angle = 2.0 * std::numbers::pi * spoke / num_spokes;
    surface.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
  }
}

// Between the ring that begins at point `lower` and the next one, seen from outside.
void add_band(DrawnSurface& surface, Index lower, Index upper) {
  for (Index spoke = 0; spoke < num_spokes; ++spoke) {
    const Index next = (spoke + 1) % num_spokes;
    surface.triangles.push_back({lower + spoke, lower + next, upper + next});
    surface.triangles.push_back({lower + spoke, upper + next, upper + spoke});
  }
}

// A disc over the ring that begins at point `ring`, looking up or down.
void add_cap(DrawnSurface& surface, Index ring, bool up) {
  const Index centre = to_index(surface.points.size());
  surface.points.emplace_back(0.0, 0.0, surface.points[at(ring)].z());
  for (Index spoke = 0; spoke < num_spokes; ++spoke) {
    const Index next = (spoke + 1) % num_spokes;
    surface.triangles.push_back({centre, ring + (up ? spoke : next), ring + (up ? next : spoke)});
  }
}

DrawnSurface drum(double radius, double bottom, double top) {
  DrawnSurface surface;
  add_ring(surface, radius, bottom);
  add_ring(surface, radius, top);
  add_band(surface, 0, num_spokes);
  add_cap(surface, 0, false);
  add_cap(surface, num_spokes, true);
  return surface;
}

// Each in the tool's frame; `view` is where to look at a half space.
struct HalfSpaceView {
  Vec3 centre;
  double radius;
};

DrawnSurface surface_of(const HalfSpace&, const HalfSpaceView& view) {
  DrawnSurface surface;
  add_ring(surface, view.radius, 0.0);
  add_cap(surface, 0, true);
  for (Vec3& point : surface.points) point += Vec3(view.centre.x(), view.centre.y(), 0.0);
  return surface;
}

DrawnSurface surface_of(const DiscPlaten& shape, const HalfSpaceView&) {
  return drum(shape.radius, -shape.thickness, 0.0);
}

DrawnSurface surface_of(const CylinderTool& shape, const HalfSpaceView&) {
  return drum(shape.radius, -0.5 * shape.length, 0.5 * shape.length);
}

DrawnSurface surface_of(const BallTool& shape, const HalfSpaceView&) {
  DrawnSurface surface;
  for (Index ring = 1; ring < num_rings; ++ring) {
    const double angle = std::numbers::pi * ring / num_rings;
    add_ring(surface, shape.radius * std::sin(angle), -shape.radius * std::cos(angle));
    if (ring > 1) add_band(surface, (ring - 2) * num_spokes, (ring - 1) * num_spokes);
  }
  add_cap(surface, 0, false);
  surface.points.back().z() = -shape.radius;
  add_cap(surface, (num_rings - 2) * num_spokes, true);
  surface.points.back().z() = shape.radius;
  return surface;
}

DrawnSurface surface_of(const SurfaceTool& shape, const HalfSpaceView&) {
  return {shape.surface.vertices, shape.surface.triangles};
}

}  // namespace

DrawnSurface tool_surface(const Tool& tool, const Vec3& centre, double radius) {
  const ToolState& state = tool.state;
  const HalfSpaceView view{state.orientation.conjugate() * Vec3(centre - state.position), radius};
  DrawnSurface surface = std::visit([&](const auto& shape) { return surface_of(shape, view); }, tool.shape);
  for (Vec3& point : surface.points) point = state.position + state.orientation * point;
  return surface;
}

}  // namespace knap
