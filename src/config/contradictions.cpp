#include "config/contradictions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "config/derived_values.hpp"
#include "config/flat_tools.hpp"
#include "config/schema.hpp"

namespace knap {
namespace {

constexpr double most_tets = 2e7;  // as the mesher allows

// "" = of the only particle.
std::string prefix(const RunConfig& config, const ParticleConfig& particle) {
  return config.particles.size() > 1 ? fmt::format("particle {}: ", particle.name) : "";
}

void check_mesh_sizes(const ParticleConfig& particle, std::vector<std::string>& found) {
  if (particle.shape == ParticleShape::MeshFile) return;
  const MeshConfig& mesh = particle.mesh;
  const double extent = smallest_extent(particle);
  if (mesh.element_size > 0.5 * extent)
    found.push_back(
        fmt::format("mesh.element_size = {} m: must be at most half the smallest extent of the particle, {} m",
                    mesh.element_size, extent));
  if (mesh.contact_element_size > mesh.element_size)
    found.push_back(fmt::format("mesh.contact_element_size = {} m: must be at most mesh.element_size, {} m",
                                mesh.contact_element_size, mesh.element_size));
  if (const double tets = estimated_num_tets(particle); !(tets <= most_tets))
    found.push_back(
        fmt::format("mesh.element_size = {} m, contact_element_size = {} m: about {:.1e} tets, allowed are "
                    "{:.0e}; larger elements or a smaller contact_extent are needed",
                    mesh.element_size, mesh.contact_element_size, tets, most_tets));
}

void check_fracture(const FractureConfig& fracture, std::vector<std::string>& found) {
  if (const double modulus = fracture.weibull_modulus; modulus > 0.0 && modulus < 1.0)
    found.push_back(
        fmt::format("fracture.weibull_modulus = {}: must be 0 (uniform strength) or from 1 to 1000", modulus));
  if (const double facets = fracture.crushed_zone_facets; facets > 0.0 && facets < 1.0)
    found.push_back(
        fmt::format("fracture.crushed_zone_facets = {}: must be 0 (mode_ii_ratio as it is) or from 1 to 100", facets));
  const double energy = fracture.fracture_energy;
  if (energy != 0.0 && !(energy >= 1e-12 && energy <= 1e9))
    found.push_back(
        fmt::format("fracture.toughness = {} Pa m^1/2: gives a fracture energy of {:.3g} J/m2, allowed are "
                    "1e-12 to 1e9 J/m2",
                    fracture.toughness, energy));
}

void check_tool(const RunConfig& config, const ToolConfig& tool, std::vector<std::string>& found) {
  const auto refuse_zero = [&](const char* key, const Vec3& direction) {
    if (direction.norm() < 1e-12)
      found.push_back(fmt::format("tool.{} = [0, 0, 0]: must point somewhere (tool {})", key, tool.name));
  };
  refuse_zero("normal", tool.normal);
  refuse_zero("axis", tool.axis);
  refuse_zero("rotation_axis", tool.rotation_axis);
  const bool is_driven = tool.motion == MotionKind::Velocity || tool.motion == MotionKind::Ramp;
  if (is_driven && tool.velocity.norm() == 0.0)
    found.push_back(fmt::format("tool.velocity = [0, 0, 0]: is rest, write motion = \"rest\" (tool {})", tool.name));
  const bool has_no_way = tool.velocity.norm() == 0.0 && config.run.gravity.norm() == 0.0;
  if (tool.motion == MotionKind::Free && has_no_way)
    found.push_back(
        fmt::format("tool.velocity is missing: a free tool moves along it or along run.gravity (tool {})", tool.name));
  if (tool.motion == MotionKind::Free && tool.type == ToolKind::Plane)
    found.push_back(fmt::format("tool.motion = \"free\": a plane has no mass; take a platen (tool {})", tool.name));
}

void check_positions(const RunConfig& config, std::vector<std::string>& found) {
  for (std::size_t i = 1; i < config.particles.size(); ++i)
    if (!config.particles[i].position)
      found.push_back(
          fmt::format("particle.position is missing: of several particles, only the first is placed on the "
                      "plane z = 0 (particle {})",
                      config.particles[i].name));
  for (const ToolConfig& tool : config.tools)
    if (tool.motion == MotionKind::Rotation && !tool.position)
      found.push_back(fmt::format("tool.position is missing: needed when motion = \"rotation\" (tool {})", tool.name));
}

// A case in which nothing would ever happen.
void check_motion(const RunConfig& config, std::vector<std::string>& found) {
  const auto& particles = config.particles;
  const auto& tools = config.tools;
  const bool particle_moves =
      config.impact.speed > 0.0 || std::any_of(particles.begin(), particles.end(), [](const ParticleConfig& particle) {
        return particle.velocity.value_or(Vec3::Zero()).norm() > 0.0;
      });
  const bool tool_moves = std::any_of(tools.begin(), tools.end(), [](const ToolConfig& tool) {
    return tool.velocity.norm() > 0.0 || tool.angular_speed != 0.0;
  });
  if (!particle_moves && !tool_moves && config.run.gravity.norm() == 0.0)
    found.emplace_back("nothing moves: give impact.speed, a particle's velocity, a tool's motion or run.gravity");
}

void check_names(const RunConfig& config, std::vector<std::string>& found) {
  std::set<std::string> tools, particles;
  if (has_wall(config)) tools.insert("wall");
  for (const ToolConfig& tool : config.tools)
    if (!tools.insert(tool.name).second)
      found.push_back(fmt::format("tool.name = \"{}\": is the name of another tool", tool.name));
  for (const ParticleConfig& particle : config.particles) {
    if (find_section(particle.name))
      found.push_back(fmt::format("particle.name = \"{}\": is the name of a section", particle.name));
    if (!particles.insert(particle.name).second)
      found.push_back(fmt::format("particle.name = \"{}\": is the name of another particle", particle.name));
  }
}

// Each impact after the first throws one piece onto the wall.
void check_repeat(const RunConfig& config, std::vector<std::string>& found) {
  const std::string what = fmt::format("impact.repeat = {}: ", config.impact.repeat);
  if (config.particles.size() != 1)
    return found.push_back(what + fmt::format("needs one particle; the case has {}", config.particles.size()));
  if (!config.tools.empty() || !has_wall(config))
    found.push_back(what + "throws the particle onto the wall; leave out [[tool]] and impact.wall");
  if (config.particles.front().velocity) found.push_back(what + "give impact.speed instead of particle.velocity");
}

// What is made of extrinsic cracks alone.
void check_intrinsic(const RunConfig& config, std::vector<std::string>& found) {
  const auto& particles = config.particles;
  if (std::none_of(particles.begin(), particles.end(),
                   [](const ParticleConfig& p) { return p.fracture.insertion == Insertion::Intrinsic; }))
    return;
  const auto refuse = [&](const char* key) {
    found.push_back(fmt::format("fracture.insertion = \"intrinsic\": cannot go with {}; take \"extrinsic\"", key));
  };
  if (config.quasistatic.enabled) refuse("quasistatic.enabled = true");
  if (config.contact.rigid_fragments) refuse("contact.rigid_fragments = true");
  if (config.impact.repeat > 1) refuse("impact.repeat > 1");
}

}  // namespace

std::vector<std::string> contradictions(const RunConfig& config) {
  std::vector<std::string> found;
  for (const ParticleConfig& particle : config.particles) {
    std::vector<std::string> own;
    check_mesh_sizes(particle, own);
    check_fracture(particle.fracture, own);
    for (const std::string& text : own) found.push_back(prefix(config, particle) + text);
  }
  for (const ToolConfig& tool : config.tools) check_tool(config, tool, found);
  check_names(config, found);
  check_positions(config, found);
  check_motion(config, found);
  if (config.quasistatic.enabled) check_quasistatic(config, found);
  if (config.impact.repeat > 1) check_repeat(config, found);
  check_intrinsic(config, found);
  return found;
}

}  // namespace knap
