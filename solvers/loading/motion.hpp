#pragma once
// How a tool moves: its pose as an exact function of time, not summed up over steps.
#include <variant>

#include "contact/tool.hpp"

namespace knap {

struct AtRest {};

struct ConstantVelocity {
  Vec3 velocity = Vec3::Zero();  ///< [m/s]
};

/// From rest, the velocity grows linearly with time, then stays.
struct Ramp {
  Vec3 velocity = Vec3::Zero();  ///< in the end [m/s]
  double ramp_time = 0.0;        ///< [s]
};

/// About an axis through a point, right-handed: a rotor's pin.
struct Rotation {
  Vec3 centre = Vec3::Zero();  ///< [m]
  Vec3 axis = Vec3::UnitZ();   ///< any length but 0
  double angular_speed = 0.0;  ///< [rad/s]
};

using ToolMotion = std::variant<AtRest, ConstantVelocity, Ramp, Rotation>;

/// Pose at a time [s] of a tool that is at `start` at time 0; before that a ramp is at rest, the others move.
ToolPose pose_at(const ToolMotion& motion, const ToolPose& start, double time);

}  // namespace knap
