#pragma once
#include <span>

#include "loading/motion.hpp"

namespace knap {

/// What a tool is made from.
struct ToolOptions {
  std::string name = "wall";
  ToolShape shape = HalfSpace{};
  Vec3 position = Vec3::Zero();  ///< of the shape's origin at the start [m]
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  double friction = 0.0;  ///< Coulomb, on the particle [-]
  ToolMotion motion = AtRest{};
};

/// A half space through a point, the particle on the side its normal points to.
ToolOptions wall(double friction = 0.0, const Vec3& point = Vec3::Zero(), const Vec3& normal = Vec3::UnitZ());

/// Everything of a tool that decides how a run goes, to tell cases apart; its name does not.
std::vector<double> defining_numbers(const ToolOptions& options);

/// The tools at time 0, each with the velocity it comes with. Throws InputError that names tool and value.
std::vector<Tool> make_tools(std::span<const ToolOptions> options, double dt);

/// Begins a step at `time` [s]: where each tool will be at its end, and with which velocity. Gravity [m/s2] moves
/// guided tools along their guides.
void aim_tools(std::span<Tool> tools, std::span<const ToolOptions> options, const Vec3& gravity, double time,
               double dt);

/// Ends a step: the tools are where they were to be.
void move_tools(std::span<Tool> tools);

}  // namespace knap
