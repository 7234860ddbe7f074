#include "loading/tool_options.hpp"

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
  for (const ToolOptions& o : options) {
    Tool tool;
    tool.name = o.name;
    tool.shape = o.shape;
    tool.friction = o.friction;
    const ToolPose before = pose_at(o.motion, {o.position, o.orientation}, -dt);
    tool.state.position = before.position;
    tool.state.orientation = before.orientation;
    tools.push_back(std::move(tool));
  }
  aim_tools(tools, options, -dt, dt);
  move_tools(tools);
  return tools;
}

void aim_tools(std::span<Tool> tools, std::span<const ToolOptions> options, double time, double dt) {
  for (std::size_t k = 0; k < tools.size(); ++k) {
    ToolState& state = tools[k].state;
    state.velocity_before = state.velocity;
    state.spin_before = state.spin;
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
