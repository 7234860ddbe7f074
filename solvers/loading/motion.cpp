#include "loading/motion.hpp"

namespace knap {
namespace {

ToolPose moved(const AtRest&, const ToolPose& start, double) { return start; }

ToolPose moved(const ConstantVelocity& motion, const ToolPose& start, double time) {
  return {start.position + time * motion.velocity, start.orientation};
}

ToolPose moved(const Ramp& motion, const ToolPose& start, double time) {
  if (time <= 0.0) return start;
  const double effective =
      time < motion.ramp_time ? 0.5 * time * time / motion.ramp_time : time - 0.5 * motion.ramp_time;
  return {start.position + effective * motion.velocity, start.orientation};
}

ToolPose moved(const Rotation& motion, const ToolPose& start, double time) {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(motion.angular_speed * time, motion.axis.normalized()));
  return {motion.centre + turn * (start.position - motion.centre), (turn * start.orientation).normalized()};
}

ToolPose moved(const Guided&, const ToolPose& start, double) { return start; }

}  // namespace

ToolPose pose_at(const ToolMotion& motion, const ToolPose& start, double time) {
  return std::visit([&](const auto& kind) { return moved(kind, start, time); }, motion);
}

}  // namespace knap
