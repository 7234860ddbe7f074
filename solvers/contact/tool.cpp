#include "contact/tool.hpp"

#include <algorithm>

namespace knap {

ToolProximity proximity(const Tool& tool, const Vec3& point) {
  const Vec3 local = tool.state.orientation.conjugate() * (point - tool.state.position);
  const SurfaceDistance distance =
      std::visit([&](const auto& shape) { return surface_distance(shape, local); }, tool.shape);
  const Vec3 normal = tool.state.orientation * distance.normal;
  return {distance.gap, normal, tool.velocity_at(point - distance.gap * normal)};
}

ToolAction& ToolAction::operator+=(const ToolAction& other) {
  push += other.push;
  impulse += other.impulse;
  angular_impulse += other.angular_impulse;
  work += other.work;
  friction_loss += other.friction_loss;
  impact_loss += other.impact_loss;
  return *this;
}

void set_guided_speed(Tool& tool, double speed, double dt) {
  tool.state.velocity = speed * tool.guide;
  tool.next = {tool.state.position + dt * tool.state.velocity, tool.state.orientation};
}

double kinetic_energy(const Tool& tool) { return 0.5 * tool.mass * tool.state.velocity.squaredNorm(); }

void book_action(Tool& tool, const ToolAction& action, double dt, std::int64_t step) {
  ToolState& state = tool.state;
  state.impulse += action.impulse;
  state.angular_impulse += action.angular_impulse;
  state.moment += action.angular_impulse - state.position.cross(action.impulse);
  state.work += action.work;
  state.friction_loss += action.friction_loss;
  state.impact_loss += action.impact_loss;
  state.max_force = std::max(state.max_force, action.push.norm() / dt);
  if (state.first_step < 0) state.first_step = step;
  state.last_step = step;
}

}  // namespace knap
