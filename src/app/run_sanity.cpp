#include "app/run_sanity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "app/simulation_options.hpp"
#include "config/derived_values.hpp"
#include "core/parallel.hpp"
#include "fem/lumped_mass.hpp"
#include "fem/stable_time_step.hpp"
#include "simulation/step.hpp"

namespace knap {
namespace {

// Critical step over (element size at the contact)/c_p of meshes as tetrahedralise makes them, measured.
constexpr double critical_step_over_crossing = 0.25;
// Wall time of a tet in an elastic step on one core [s].
constexpr double elastic_cost = 15e-9;
// Mean cost of a step of a run that breaks, over that of an elastic step.
constexpr double breaking_over_elastic = 20.0;
// From this part of the critical speed on, cracks are to be expected.
constexpr double breaking_speed_ratio = 0.7;
// A run stops by itself when nothing has happened for so many d/c_p; an elastic one, which it takes half of one to meet
// the wall and leave it for good, that long after its contact.
constexpr double quiet_crossings = 10.0;
constexpr double crossings_after_contact = quiet_crossings + 0.5;
// Breakage goes on for about so many d/c_p; contact that lasts longer, as slow impacts' does, is seen to its end.
constexpr double crossings_to_break = 50.0;
constexpr double latest_crossings_after_contact = 20.0;
// Meshes up to this size are copied to time a few steps.
constexpr Index most_tets_to_copy = 500000;

// Speed and angle at which the fastest of those meet that a case has: particles, wall and tools.
constexpr double right_angle = std::numbers::pi / 2.0;

struct Approach {
  double speed = 0.0;           ///< [m/s]
  double angle = right_angle;   ///< from the surface [rad]
  double pressing_speed = 0.0;  ///< of the fastest tool that goes on [m/s]
};

Vec3 start_velocity(const ToolConfig& tool) {
  const Vec3 arm = tool.position.value_or(tool.rotation_centre) - tool.rotation_centre;
  return tool.motion == MotionKind::Rotation ? Vec3(tool.angular_speed * tool.rotation_axis.normalized().cross(arm))
                                             : tool.velocity;
}

// What the particle will not stop: a driven tool, or a free one that is heavier.
bool goes_on_pressing(const ToolConfig& tool, const ParticleConfig& particle) {
  if (tool.motion == MotionKind::Free) return tool.mass > particle.material.density * particle_volume(particle);
  return tool.motion == MotionKind::Velocity || tool.motion == MotionKind::Ramp;
}

Approach approach(const RunConfig& config) {
  Approach result;
  const auto see = [&](double speed, double angle) {
    if (speed > result.speed) result.speed = speed, result.angle = angle;
  };
  for (const ParticleConfig& particle : config.particles) {
    const Vec3 velocity = start_velocity(config, particle);
    if (has_wall(config) && !particle.velocity)
      see(config.impact.speed, config.impact.angle);
    else if (has_wall(config))
      see(velocity.norm(), std::asin(std::clamp(-velocity.z() / std::max(velocity.norm(), 1e-300), 0.0, 1.0)));
    for (const ParticleConfig& other : config.particles)
      see((velocity - start_velocity(config, other)).norm(), right_angle);
    for (const ToolConfig& tool : config.tools) see((start_velocity(tool) - velocity).norm(), right_angle);
  }
  if (result.speed == 0.0)  // by gravity alone: a fall of the size of the particles
    see(std::sqrt(2.0 * config.run.gravity.norm() * std::cbrt(particle_volume(config.particles.front()))), right_angle);
  for (const ToolConfig& tool : config.tools)
    if (goes_on_pressing(tool, config.particles.front()))
      result.pressing_speed = std::max(result.pressing_speed, tool.velocity.norm());
  return result;
}

// How long tools press at most: this part of the particle's diameter, and what their ramp takes.
double press_time(const RunConfig& config, double diameter) {
  constexpr double share_of_diameter = 0.25;
  const double speed = approach(config).pressing_speed;
  if (speed == 0.0) return 0.0;
  double ramp = 0.0;
  for (const ToolConfig& tool : config.tools) ramp = std::max(ramp, tool.ramp_time);
  return share_of_diameter * diameter / speed + ramp;
}

SanityInput material_input(const ParticleConfig& particle) {
  SanityInput input{.young_modulus = particle.material.young_modulus,
                    .poisson_ratio = particle.material.poisson_ratio,
                    .density = particle.material.density};
  const FractureConfig& fracture = particle.fracture;
  if (fracture.insertion != Insertion::None)
    input.fracture = FractureScale{.strength = fracture.strength,
                                   .fracture_energy = fracture.fracture_energy,
                                   .shear_strength_ratio = fracture.shear_strength_ratio,
                                   .mode_ii_ratio = fracture.mode_ii_ratio,
                                   .crushed_zone_facets = fracture.crushed_zone_facets};
  return input;
}

SanityInput case_input(const RunConfig& config) {
  const Approach meeting = approach(config);
  SanityInput input = material_input(config.particles[0]);
  input.speed = meeting.speed;
  input.angle = meeting.angle;
  input.end_time = config.run.end_time;
  return input;
}

double volume_diameter(double volume) { return std::cbrt(6.0 / std::numbers::pi * volume); }

bool is_expected_to_break(const SanityCard& card) {
  const bool is_fast = card.fracture && card.normal_speed > breaking_speed_ratio * card.fracture->critical_speed;
  return is_fast || (card.fracture && card.input.press_time > 0.0);
}

// Until the particle meets what it strikes.
double approach_time(const SanityCard& card) {
  return initial_gap(card.input.contact_element_size) / card.normal_speed;
}

// The latest end of a run that stops by itself. A broken one often gets there: dust keeps touching the wall.
double latest_end(const SanityCard& card) {
  const double impact = std::max(crossings_to_break * card.crossing_time,
                                 card.contact_time + latest_crossings_after_contact * card.crossing_time);
  return approach_time(card) + std::max(impact, card.input.press_time);
}

double expected_end(const SanityCard& card, bool breaks) {
  return breaks || card.input.press_time > 0.0
             ? latest_end(card)
             : approach_time(card) + card.contact_time + crossings_after_contact * card.crossing_time;
}

// The card with end, steps and wall time to expect; `elastic` is the cost of an elastic step over the tets.
SanityCard card_with_cost(const SanityInput& input, double elastic) {
  SanityCard card = sanity_card(input);
  const bool breaks = is_expected_to_break(card);
  if (!input.end_time) card.end_time = expected_end(card, breaks);
  card.num_steps = std::ceil(card.end_time / input.time_step->dt);
  card.input.cost_per_tet_step = elastic * (breaks ? breaking_over_elastic : 1.0);
  card.wall_time = card.num_steps * input.num_tets * card.input.cost_per_tet_step;
  return card;
}

SanityCard card_with_estimated_step(const RunConfig& config, SanityInput input) {
  const double crossing = input.contact_element_size / sanity_card(input).p_wave_speed;
  input.time_step = {config.run.step_safety * critical_step_over_crossing * crossing,
                     "the contact's elements; estimated"};
  return card_with_cost(input, elastic_cost / num_threads());
}

// The vertex with the shortest critical step as long as nothing is cracked there, for the reader.
std::string step_limit(const Simulation& s) {
  const std::vector<Vec3>& x = s.reference.vertices;
  Index worst = 0;
  double largest = 0.0;
  for (Index i = 0; i < s.topology.num_vertices(); ++i) {
    const auto corners = s.topology.corners_of_vertex[i];
    const double mass = corner_sum(corners, s.reference.corner_mass);
    const double bound = nodal_frequency_bound2(corners, s.reference.corner_stiffness, mass);
    if (bound > largest) worst = i, largest = bound;
  }
  double edge = 1e300;
  for (const Index corner : s.topology.corners_of_vertex[worst])
    for (const Index other : s.topology.tet_vertices[at(corner >> 2)])
      if (other != worst) edge = std::min(edge, (x[at(other)] - x[at(worst)]).norm());
  return fmt::format("a node {:.3g} mm above the wall, shortest edge {:.3g} um", 1e3 * x[at(worst)].z(), 1e6 * edge);
}

// Per tet and step; the median over a few steps, because other programs may use the machine too.
double measured_elastic_cost(const Simulation& s) {
  using Clock = std::chrono::steady_clock;
  Simulation copy = s;
  std::array<double, 25> seconds{};
  for (double& duration : seconds) {
    const auto start = Clock::now();
    step(copy);
    duration = std::chrono::duration<double>(Clock::now() - start).count();
  }
  std::nth_element(seconds.begin(), seconds.begin() + seconds.size() / 2, seconds.end());
  return seconds[seconds.size() / 2] / s.topology.num_tets();
}

SanityInput mesh_input(const RunConfig& config, const ParticleMesh& particle) {
  SanityInput input = case_input(config);
  input.diameter = particle.diameter;
  input.press_time = press_time(config, particle.diameter);
  input.volume = particle.quality.total_volume;
  input.contact_element_size = particle.contact_element_size;
  input.element_size = particle.element_size;
  input.num_tets = particle.mesh.num_tets();
  return input;
}

SanityCard estimated_card(const RunConfig& config, const Shape& shape) {
  SanityInput input = case_input(config);
  input.volume = volume(shape);
  input.diameter = volume_diameter(input.volume);
  input.press_time = press_time(config, input.diameter);
  input.contact_element_size = config.particles[0].mesh.contact_element_size;
  input.element_size = config.particles[0].mesh.element_size;
  input.num_tets = static_cast<Index>(expected_num_tets(shape, mesh_options(config.particles[0].mesh, shape)));
  return card_with_estimated_step(config, std::move(input));
}

}  // namespace

double mode_ii_ratio(const ParticleConfig& particle, const ParticleMesh& mesh) {
  SanityInput input = material_input(particle);
  if (!input.fracture) return particle.fracture.mode_ii_ratio;
  input.diameter = mesh.diameter;
  input.contact_element_size = mesh.contact_element_size;
  return mesh_mode_ii_ratio(input);
}

SanityCard expected_card(const RunConfig& config) {
  if (const auto shape = particle_shape(config.particles[0])) return estimated_card(config, *shape);
  return card_with_estimated_step(config, mesh_input(config, make_particle_mesh(config.particles[0])));
}

SanityCard run_card(const RunConfig& config, const ParticleMesh& particle, const Simulation& s) {
  SanityInput input = mesh_input(config, particle);
  input.num_tets = s.topology.num_tets();
  input.time_step = {s.clock.dt, step_limit(s)};
  const bool timed = s.topology.num_tets() <= most_tets_to_copy && s.cracks.records.empty();
  return card_with_cost(input, timed ? measured_elastic_cost(s) : elastic_cost / num_threads());
}

RunLimits run_limits(const SanityCard& card) {
  if (card.input.end_time) return {.end_time = *card.input.end_time, .automatic = false};
  return {.end_time = latest_end(card), .automatic = true, .quiet_time = quiet_crossings * card.crossing_time};
}

}  // namespace knap
