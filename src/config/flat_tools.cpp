#include "config/flat_tools.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace knap {
namespace {

constexpr double same_direction = 1e-9;  // of unit vectors

struct FlatTool {
  Vec3 normal;
  Vec3 velocity;
};

bool is_flat(const ToolConfig& tool) { return tool.type == ToolKind::Plane || tool.type == ToolKind::Platen; }
bool is_driven(const ToolConfig& tool) {
  return tool.motion == MotionKind::Velocity || tool.motion == MotionKind::Ramp;
}

std::vector<FlatTool> flat_tools(const RunConfig& config) {
  std::vector<FlatTool> tools;
  if (has_wall(config)) tools.push_back({Vec3::UnitZ(), Vec3::Zero()});
  for (const ToolConfig& tool : config.tools)
    if (is_flat(tool)) tools.push_back({tool.normal.normalized(), is_driven(tool) ? tool.velocity : Vec3::Zero()});
  return tools;
}

void check_tool(const ToolConfig& tool, std::vector<std::string>& found) {
  if (!is_flat(tool))
    found.push_back(fmt::format(
        "quasistatic.enabled = true: needs flat tools, type = \"plane\" or \"platen\" (tool {})", tool.name));
  if (tool.motion == MotionKind::Rotation || tool.motion == MotionKind::Free)
    found.push_back(fmt::format(
        "quasistatic.enabled = true: needs tools with motion = \"rest\", \"velocity\" or \"ramp\" (tool {})",
        tool.name));
  const Vec3 normal = tool.normal.normalized();
  if (is_driven(tool) &&
      (tool.velocity - tool.velocity.dot(normal) * normal).norm() > same_direction * tool.velocity.norm())
    found.push_back(
        fmt::format("tool.velocity: must be along tool.normal when quasistatic.enabled = true (tool {})", tool.name));
}

void check_pair(const std::vector<FlatTool>& tools, std::vector<std::string>& found) {
  if ((tools[0].normal + tools[1].normal).norm() > same_direction) {
    found.emplace_back("quasistatic.enabled = true: the two tools must face each other, with opposite tool.normal");
    return;
  }
  const double speed = tools[0].velocity.dot(tools[0].normal) + tools[1].velocity.dot(tools[1].normal);
  if (!(speed > 0.0))
    found.emplace_back(
        "quasistatic.enabled = true: the two tools must come nearer to each other; give one of them motion = "
        "\"velocity\" "
        "or \"ramp\" and a tool.velocity along its normal");
}

}  // namespace

bool flat_tools_press_along_z(const RunConfig& config) {
  const auto tools = flat_tools(config);
  const auto any_looks = [&](const Vec3& direction) {
    return std::any_of(tools.begin(), tools.end(),
                       [&](const FlatTool& tool) { return (tool.normal - direction).norm() < same_direction; });
  };
  return any_looks(Vec3::UnitZ()) && any_looks(-Vec3::UnitZ());
}

void check_quasistatic(const RunConfig& config, std::vector<std::string>& found) {
  const std::size_t before = found.size();
  if (const std::size_t tools = config.tools.size() + (has_wall(config) ? 1 : 0); tools != 2)
    found.push_back(fmt::format(
        "quasistatic.enabled = true: needs the particle between two flat tools, two [[tool]] or impact.wall = true and "
        "one [[tool]]; the case has {}",
        tools));
  for (const ToolConfig& tool : config.tools) check_tool(tool, found);
  if (found.size() == before) check_pair(flat_tools(config), found);
  if (config.run.gravity.norm() > 0.0)
    found.emplace_back("run.gravity: must be [0, 0, 0] when quasistatic.enabled = true");
  if (config.particles.size() != 1)
    return found.push_back(
        fmt::format("quasistatic.enabled = true: needs one particle; the case has {}", config.particles.size()));
  const ParticleConfig& particle = config.particles.front();
  const bool moves = config.impact.speed > 0.0 && !particle.velocity;
  if (moves || particle.velocity.value_or(Vec3::Zero()).norm() > 0.0)
    found.push_back(fmt::format("{}: the particle must be at rest when quasistatic.enabled = true; leave it out",
                                moves ? "impact.speed" : "particle.velocity"));
  if (particle.spin.value_or(config.impact.spin).norm() > 0.0)
    found.push_back(fmt::format("{}: the particle must be at rest when quasistatic.enabled = true; leave it out",
                                particle.spin ? "particle.spin" : "impact.spin"));
  if (particle.fracture.insertion == Insertion::None)
    found.emplace_back(
        "fracture.insertion = \"none\": nothing breaks, so that there is no onset; leave it out or "
        "quasistatic.enabled");
}

}  // namespace knap
