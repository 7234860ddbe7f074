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

/// A mass of its own, free to move along an axis only, as on rails: a drop weight. The particle's impulses and gravity
/// along the axis move it; what acts across, the rails take.
struct Guided {
  Vec3 axis = -Vec3::UnitZ();  ///< any length but 0
  double speed = 0.0;          ///< along the axis at the start [m/s]
  double mass = 0.0;           ///< [kg]
};

using ToolMotion = std::variant<AtRest, ConstantVelocity, Ramp, Rotation, Guided>;

/// Pose at a time [s] of a tool that is at `start` at time 0; before that a ramp is at rest, the others move. A
/// guided tool is where it was: its motion is no function of time.
ToolPose pose_at(const ToolMotion& motion, const ToolPose& start, double time);

}  // namespace knap
