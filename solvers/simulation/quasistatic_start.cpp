#include "simulation/quasistatic_start.hpp"

#include <fmt/format.h>

#include "core/errors.hpp"
#include "simulation/make_simulation.hpp"
#include "simulation/step.hpp"

namespace knap {
namespace {

// Relaxation times until nothing of the branch's stress is left: exp(-40).
constexpr double times_to_relax = 40.0;

Vec3 constant_velocity(const ToolOptions& tool) {
  if (std::holds_alternative<AtRest>(tool.motion)) return Vec3::Zero();
  if (const auto* motion = std::get_if<ConstantVelocity>(&tool.motion)) return motion->velocity;
  if (const auto* motion = std::get_if<Ramp>(&tool.motion)) return motion->velocity;  // it has risen long ago
  throw InputError(fmt::format("quasistatic: tool \"{}\" must be at rest or have a constant velocity", tool.name));
}

Platen platen(const ToolOptions& tool) {
  Platen platen{.point = tool.position, .normal = tool.orientation * Vec3::UnitZ(), .friction = tool.friction};
  if (const auto* disc = std::get_if<DiscPlaten>(&tool.shape)) {
    platen.radius = disc->radius;
  } else if (!std::holds_alternative<HalfSpace>(tool.shape)) {
    throw InputError(fmt::format("quasistatic: tool \"{}\" is not flat; planes and platens can be used", tool.name));
  }
  return platen;
}

struct Press {
  std::array<Platen, 2> platens;
  double speed = 0.0;  // of approach [m/s]
};

Press press(const Simulation& s) {
  const auto& tools = s.options.tools;
  if (tools.size() != 2)
    throw InputError(
        fmt::format("quasistatic: the particle must lie between two tools; the case has {}", tools.size()));
  if (s.options.particles.size() != 1) throw InputError("quasistatic: the case must have one particle");
  const ParticleOptions& particle = s.options.particles.front();
  if (!particle.fracture) throw InputError("quasistatic: needs a material that can break (fracture.insertion)");
  if (!particle.velocity.isZero() || !particle.spin.isZero())
    throw InputError("quasistatic: the particle must be at rest at the start");
  Press press{{platen(tools[0]), platen(tools[1])}, 0.0};
  std::array<double, 2> speed{};
  for (std::size_t k = 0; k < 2; ++k) {
    const Vec3 velocity = constant_velocity(tools[k]);
    speed[k] = velocity.dot(press.platens[k].normal);
    if ((velocity - speed[k] * press.platens[k].normal).norm() > 1e-9 * velocity.norm())
      throw InputError(fmt::format("quasistatic: tool \"{}\" must move along its normal", tools[k].name));
  }
  press.speed = speed[0] + speed[1];
  if (!(press.speed > 0.0)) throw InputError("quasistatic: the two tools must come nearer to each other");
  for (std::size_t k = 0; k < 2; ++k) press.platens[k].share = speed[k] / press.speed;
  return press;
}

void relax_branch(Simulation& s) {
  const double time = s.elastic.materials.front().branch.relaxation_time;
  if (!s.elastic.branch.groups.empty()) update_elastic_forces(s.elastic, s.nodes.x, s.nodes.f, times_to_relax * time);
  s.elastic.branch.pending = s.elastic.branch.dissipated = 0.0;
  update_elastic_forces(s.elastic, s.nodes.x, s.nodes.f, 0.0);
}

}  // namespace

Onset start_at_onset(Simulation& s, const LoadPathOptions& options) {
  const Press press = knap::press(s);
  Onset onset = load_to_onset({s.topology, s.reference.vertices, s.elastic.materials.front()}, press.platens,
                              {s.reference.laws.front(), s.reference.facet_strength}, options);
  for (std::size_t k = 0; k < 2; ++k) {
    ToolOptions& tool = s.options.tools[k];
    tool.position += onset.path[k];
    if (const auto* motion = std::get_if<Ramp>(&tool.motion)) tool.motion = ConstantVelocity{Vec3(motion->velocity)};
  }
  s.reference.tool_path.assign(onset.path.begin(), onset.path.end());
  s.tools = make_tools(s.options.tools, s.clock.dt);
  s.nodes.x = onset.x;
  for (std::size_t i = 0; i < s.nodes.v.size(); ++i) s.nodes.v[i] = press.speed * onset.rate[i];
  s.nodes.v_before = s.nodes.v;
  relax_branch(s);
  balance_from_here(s);
  return onset;
}

}  // namespace knap
