#pragma once
// A tool: a rigid body that loads the particle.
#include <string>

#include "contact/tool_shape.hpp"

namespace knap {

/// Where a tool's frame is in the world: x_world = position + orientation * x_tool.
struct ToolPose {
  Vec3 position = Vec3::Zero();                                     ///< [m]
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< unit
};

/// All that changes of a tool, and what it has done since the start.
struct ToolState {
  Vec3 position = Vec3::Zero();                                     ///< at the time of nodes.x [m]
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< at the time of nodes.x
  Vec3 velocity = Vec3::Zero();         ///< of its position, mean over the step that begins at nodes.x [m/s]
  Vec3 spin = Vec3::Zero();             ///< the same of its rotation [rad/s]
  Vec3 velocity_before = Vec3::Zero();  ///< over the step before [m/s]
  Vec3 spin_before = Vec3::Zero();      ///< [rad/s]
  Vec3 impulse = Vec3::Zero();          ///< on the particle [N s]
  Vec3 angular_impulse = Vec3::Zero();  ///< on the particle, about the world's origin [N m s]
  Vec3 moment = Vec3::Zero();           ///< on the particle, about the tool's position at each step, summed [N m s]
  double work = 0.0;                    ///< done on the particle by the tool's motion, losses included [J]
  double friction_loss = 0.0;           ///< [J]
  double impact_loss = 0.0;             ///< kinetic energy of nodes stopped on the surface [J]
  double max_force = 0.0;               ///< largest sum of the normal forces of one step [N]
  std::int64_t first_step = -1;         ///< with the particle on it; -1 = never
  std::int64_t last_step = -1;

  ToolPose pose() const { return {position, orientation}; }
};

struct Tool {
  std::string name;
  ToolShape shape = HalfSpace{};
  double friction = 0.0;       ///< Coulomb, on the particle [-]
  double mass = 0.0;           ///< of a tool that the particle pushes back [kg]; 0 = its motion is prescribed
  Vec3 guide = Vec3::UnitZ();  ///< unit; such a tool moves along it only, as on rails, and does not turn
  ToolState state;
  ToolPose next;  ///< at the end of the step

  bool is_guided() const { return mass > 0.0; }
  /// Mean velocity, over the step that begins now, of the tool's matter at a point of the world [m/s].
  Vec3 velocity_at(const Vec3& point) const { return state.velocity + state.spin.cross(point - state.position); }
};

/// A point of the world and the tool's surface, at the time of nodes.x.
struct ToolProximity {
  double gap;     ///< [m], negative inside the tool
  Vec3 normal;    ///< unit, out of the tool
  Vec3 velocity;  ///< of the tool's surface there, mean over the step that begins now [m/s]
};

/// With it, a point of velocity v stays out if gap + dt (v - velocity).normal >= 0.
ToolProximity proximity(const Tool& tool, const Vec3& point);

/// What a tool did to the particle in one step.
struct ToolAction {
  Vec3 push = Vec3::Zero();             ///< sum of the normal impulses [N s]
  Vec3 impulse = Vec3::Zero();          ///< with friction [N s]
  Vec3 angular_impulse = Vec3::Zero();  ///< about the world's origin [N m s]
  double work = 0.0;                    ///< of the impulses at the tool's velocity [J]
  double friction_loss = 0.0;           ///< [J]
  double impact_loss = 0.0;             ///< [J]

  ToolAction& operator+=(const ToolAction& other);
};

/// Of a guided tool: its speed along the guide for the step that begins [m/s].
void set_guided_speed(Tool& tool, double speed, double dt);
/// At the half step; 0 for a prescribed motion [J].
double kinetic_energy(const Tool& tool);

/// Adds what a step did to the tool's sums.
void book_action(Tool& tool, const ToolAction& action, double dt, std::int64_t step);

}  // namespace knap
