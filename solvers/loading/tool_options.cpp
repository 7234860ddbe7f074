#include "loading/tool_options.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/errors.hpp"

namespace knap {
namespace {

Vec3 rotation_vector(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to) {
  if (from.coeffs() == to.coeffs()) return Vec3::Zero();
  const Eigen::AngleAxisd turn(to * from.conjugate());
  return turn.angle() * turn.axis();
}

void add(std::vector<double>& numbers, const Vec3& a) { numbers.insert(numbers.end(), {a.x(), a.y(), a.z()}); }

void add(std::vector<double>&, const HalfSpace&) {}
void add(std::vector<double>& numbers, const DiscPlaten& shape) {
  numbers.insert(numbers.end(), {shape.radius, shape.thickness});
}
void add(std::vector<double>& numbers, const BallTool& shape) { numbers.push_back(shape.radius); }
void add(std::vector<double>& numbers, const CylinderTool& shape) {
  numbers.insert(numbers.end(), {shape.radius, shape.length});
}

void add(std::vector<double>& numbers, const SurfaceTool& shape) {
  numbers.push_back(shape.thickness);
  for (const Vec3& vertex : shape.surface.vertices) add(numbers, vertex);
  for (const Triangle& triangle : shape.surface.triangles)
    numbers.insert(numbers.end(), triangle.begin(), triangle.end());
}

void add(std::vector<double>&, const AtRest&) {}
void add(std::vector<double>& numbers, const ConstantVelocity& motion) { add(numbers, motion.velocity); }
void add(std::vector<double>& numbers, const Ramp& motion) {
  add(numbers, motion.velocity);
  numbers.push_back(motion.ramp_time);
}
void add(std::vector<double>& numbers, const Rotation& motion) {
  add(numbers, motion.centre);
  add(numbers, motion.axis);
  numbers.push_back(motion.angular_speed);
}
void add(std::vector<double>& numbers, const Guided& motion) {
  add(numbers, motion.axis);
  numbers.insert(numbers.end(), {motion.speed, motion.mass});
}

void require(bool condition, const ToolOptions& options, std::string_view what) {
  if (!condition) throw InputError(fmt::format("tool '{}': {}", options.name, what));
}

void check(const ToolOptions&, const HalfSpace&) {}
void check(const ToolOptions& options, const DiscPlaten& shape) {
  require(shape.radius > 0.0 && shape.thickness > 0.0, options, "radius and thickness of a platen must be above 0");
}
void check(const ToolOptions& options, const BallTool& shape) {
  require(shape.radius > 0.0, options, "the radius must be above 0");
}
void check(const ToolOptions& options, const CylinderTool& shape) {
  require(shape.radius > 0.0 && shape.length > 0.0, options, "radius and length of a cylinder must be above 0");
}

void check(const ToolOptions& options, const SurfaceTool& shape) {
  require(!shape.surface.tree.empty(), options, "the surface has no triangles");
  require(shape.thickness >= 0.0, options, "the thickness must not be negative");
  if (shape.surface.closed || shape.thickness > 0.0) return;
  const Rim rim = rim_of(shape.surface);
  require(
      false, options,
      fmt::format("the surface is open: {} edges have one triangle only, the first near ({:.4g}, {:.4g}, {:.4g}) mm; "
                  "close it, or give the thickness of a shell",
                  rim.num_edges, 1e3 * rim.place.x(), 1e3 * rim.place.y(), 1e3 * rim.place.z()));
}

void check(const ToolOptions&, const AtRest&) {}
void check(const ToolOptions&, const ConstantVelocity&) {}
void check(const ToolOptions& options, const Ramp& motion) {
  require(motion.ramp_time > 0.0, options, "the ramp time must be above 0; without a ramp, give a constant velocity");
}
void check(const ToolOptions& options, const Rotation& motion) {
  require(motion.axis.norm() > 0.0, options, "the axis of rotation must not be zero");
}
void check(const ToolOptions& options, const Guided& motion) {
  require(motion.axis.norm() > 0.0, options, "the axis it is guided along must not be zero");
  require(motion.mass > 0.0, options, "the mass must be above 0");
}

}  // namespace

std::vector<double> defining_numbers(const ToolOptions& options) {
  const Eigen::Vector4d turn = options.orientation.coeffs();
  std::vector<double> numbers{turn[0], turn[1], turn[2], turn[3], options.friction};
  add(numbers, options.position);
  numbers.push_back(static_cast<double>(options.shape.index()));
  std::visit([&](const auto& shape) { add(numbers, shape); }, options.shape);
  numbers.push_back(static_cast<double>(options.motion.index()));
  std::visit([&](const auto& motion) { add(numbers, motion); }, options.motion);
  return numbers;
}

namespace {

void check(const ToolOptions& options) {
  for (const double number : defining_numbers(options))
    require(std::isfinite(number), options, "a value is not finite");
  require(options.friction >= 0.0, options, "friction must not be negative");
  require(std::abs(options.orientation.norm() - 1.0) < 1e-9, options, "the orientation must be a unit quaternion");
  std::visit([&](const auto& shape) { check(options, shape); }, options.shape);
  std::visit([&](const auto& motion) { check(options, motion); }, options.motion);
}

Tool make_tool(const ToolOptions& options, double dt) {
  check(options);
  Tool tool;
  tool.name = options.name;
  tool.shape = options.shape;
  tool.friction = options.friction;
  ToolPose before{options.position, options.orientation};
  if (const auto* guided = std::get_if<Guided>(&options.motion)) {
    tool.mass = guided->mass;
    tool.guide = guided->axis.normalized();
    tool.state.velocity = guided->speed * tool.guide;
    before.position -= dt * tool.state.velocity;
  } else {
    before = pose_at(options.motion, before, -dt);
  }
  tool.state.position = before.position;
  tool.state.orientation = before.orientation;
  return tool;
}

}  // namespace

ToolOptions wall(double friction, const Vec3& point, const Vec3& normal) {
  ToolOptions options;
  options.position = point;
  options.orientation = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), normal);
  options.friction = friction;
  return options;
}

std::vector<Tool> make_tools(std::span<const ToolOptions> options, double dt) {
  std::vector<Tool> tools;
  tools.reserve(options.size());
  for (const ToolOptions& one : options) tools.push_back(make_tool(one, dt));
  aim_tools(tools, options, Vec3::Zero(), -dt, dt);
  move_tools(tools);
  return tools;
}

void aim_tools(std::span<Tool> tools, std::span<const ToolOptions> options, const Vec3& gravity, double time,
               double dt) {
  for (std::size_t k = 0; k < tools.size(); ++k) {
    ToolState& state = tools[k].state;
    state.velocity_before = state.velocity;
    state.spin_before = state.spin;
    if (tools[k].is_guided()) {
      set_guided_speed(tools[k], tools[k].guide.dot(state.velocity + dt * gravity), dt);
      continue;
    }
    tools[k].next = pose_at(options[k].motion, {options[k].position, options[k].orientation}, time + dt);
    state.velocity = (tools[k].next.position - state.position) / dt;
    state.spin = rotation_vector(state.orientation, tools[k].next.orientation) / dt;
  }
}

void move_tools(std::span<Tool> tools) {
  for (Tool& tool : tools) {
    tool.state.position = tool.next.position;
    tool.state.orientation = tool.next.orientation;
  }
}

}  // namespace knap
