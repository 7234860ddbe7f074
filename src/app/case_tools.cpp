#include "app/case_tools.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/read_stl.hpp"
#include "core/errors.hpp"

namespace knap {
namespace {

ToolShape shape_of(const ToolConfig& tool) {
  switch (tool.type) {
    case ToolKind::Platen:
      return DiscPlaten{tool.radius, tool.thickness};
    case ToolKind::Sphere:
      return BallTool{tool.radius};
    case ToolKind::Cylinder:
      return CylinderTool{tool.radius, tool.length};
    case ToolKind::Stl:
      return SurfaceTool{load_stl(tool.file, tool.scale), tool.thickness};
    case ToolKind::Plane:
      break;
  }
  return HalfSpace{};
}

// Along which a free tool moves.
Vec3 way_of(const ToolConfig& tool, const Vec3& gravity) {
  return tool.velocity.norm() > 0.0 ? tool.velocity : gravity;
}

ToolMotion motion_of(const ToolConfig& tool, const Vec3& gravity) {
  switch (tool.motion) {
    case MotionKind::Velocity:
      return ConstantVelocity{tool.velocity};
    case MotionKind::Ramp:
      return Ramp{tool.velocity, tool.ramp_time};
    case MotionKind::Rotation:
      return Rotation{tool.rotation_centre, tool.rotation_axis, tool.angular_speed};
    case MotionKind::Free:
      return Guided{way_of(tool, gravity), tool.velocity.norm(), tool.mass};
    case MotionKind::Rest:
      break;
  }
  return AtRest{};
}

bool has_face(const ToolConfig& tool) { return tool.type == ToolKind::Plane || tool.type == ToolKind::Platen; }

Eigen::Quaterniond orientation_of(const ToolConfig& tool) {
  const Vec3 z = tool.type == ToolKind::Cylinder ? tool.axis : tool.normal;
  return Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), z);
}

// Where a tool comes from, pointing to the particle.
Vec3 direction_of_approach(const ToolConfig& tool, const Vec3& gravity) {
  const Vec3 way = tool.motion == MotionKind::Free ? way_of(tool, gravity) : tool.velocity;
  const bool moves = way.norm() > 0.0 && tool.motion != MotionKind::Rest;
  if (moves && !has_face(tool)) return way.normalized();
  return has_face(tool) || tool.type == ToolKind::Stl ? Vec3(tool.normal.normalized()) : Vec3(Vec3::UnitZ());
}

double least_gap(const Tool& tool, std::span<const TetMesh> particles) {
  double least = std::numeric_limits<double>::infinity();
  for (const TetMesh& mesh : particles)
    for (const Vec3& x : mesh.vertices) least = std::min(least, proximity(tool, x).gap);
  return least;
}

// Moves a tool towards the particles by its gap again and again: the gap is a distance, so no step goes too far, and
// the steps shrink by a constant factor at least once the nearest vertex is ahead.
Vec3 place_in_touch(const ToolOptions& options, const Vec3& direction, std::span<const TetMesh> particles, double gap) {
  constexpr int most_steps = 1000;
  Eigen::AlignedBox3d box;
  for (const TetMesh& mesh : particles)
    for (const Vec3& x : mesh.vertices) box.extend(x);
  const ShapeBox own = std::visit([](const auto& shape) { return bounding_box(shape); }, options.shape);
  const double depth = std::max(own.low.cwiseAbs().maxCoeff(), own.high.cwiseAbs().maxCoeff());
  const double reach = box.diagonal().norm() + (std::isfinite(depth) ? 2.0 * depth : 0.0);
  Tool tool = make_tools(std::span(&options, 1), 1.0).front();
  tool.state.position = box.center() - reach * direction;
  for (int i = 0; i < most_steps; ++i) {
    const double way = least_gap(tool, particles) - gap;
    tool.state.position += way * direction;
    if (way < 1e-6 * gap) return tool.state.position;
    if ((tool.state.position - box.center()).dot(direction) > reach) break;
  }
  throw InputError(fmt::format("tool.position: tool {} would miss the particle; say where it is", options.name));
}

}  // namespace

std::vector<ToolOptions> tool_options(const RunConfig& config, std::span<const TetMesh> particles, double gap) {
  std::vector<ToolOptions> tools;
  if (has_wall(config)) tools.push_back(wall(config.impact.wall_friction));
  for (const ToolConfig& tool : config.tools) {
    ToolOptions options{.name = tool.name,
                        .shape = shape_of(tool),
                        .position = tool.position.value_or(Vec3::Zero()),
                        .orientation = orientation_of(tool),
                        .friction = tool.friction,
                        .motion = motion_of(tool, config.run.gravity)};
    if (!tool.position)
      options.position = place_in_touch(options, direction_of_approach(tool, config.run.gravity), particles, gap);
    tools.push_back(std::move(options));
  }
  return tools;
}

}  // namespace knap
