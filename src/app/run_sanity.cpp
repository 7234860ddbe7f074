#include "app/run_sanity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "core/parallel.hpp"
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

SanityInput material_input(const RunConfig& config) {
  SanityInput input{.young_modulus = config.particles[0].material.young_modulus,
                    .poisson_ratio = config.particles[0].material.poisson_ratio,
                    .density = config.particles[0].material.density,
                    .speed = config.impact.speed,
                    .angle = config.impact.angle,
                    .end_time = config.run.end_time};
  const FractureConfig& fracture = config.particles[0].fracture;
  if (fracture.insertion != Insertion::None)
    input.fracture = {fracture.strength, fracture.fracture_energy, fracture.shear_strength_ratio};
  return input;
}

double volume_diameter(double volume) { return std::cbrt(6.0 / std::numbers::pi * volume); }

bool is_expected_to_break(const SanityCard& card) {
  return card.fracture && card.normal_speed > breaking_speed_ratio * card.fracture->critical_speed;
}

// Until the particle meets the wall.
double approach_time(const SanityCard& card) {
  return initial_gap(card.input.contact_element_size) / card.normal_speed;
}

// The latest end of a run that stops by itself. A broken one often gets there: dust keeps touching the wall.
double latest_end(const SanityCard& card) {
  return approach_time(card) + std::max(crossings_to_break * card.crossing_time,
                                        card.contact_time + latest_crossings_after_contact * card.crossing_time);
}

double expected_end(const SanityCard& card, bool breaks) {
  return breaks ? latest_end(card)
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

// The node with the shortest critical step, for the reader.
std::string step_limit(const Simulation& s, const TetMesh& mesh) {
  Index worst = 0;
  double largest = 0.0;
  for (Index i = 0; i < s.nodes.size(); ++i) {
    const double bound =
        nodal_frequency_bound2(s.topology.corners_of_vertex[i], s.reference.corner_stiffness, s.nodes.mass[at(i)]);
    if (bound > largest) worst = i, largest = bound;
  }
  double edge = 1e300;
  for (const Index corner : s.topology.corners_of_vertex[worst])
    for (const Index other : s.topology.tet_vertices[at(corner >> 2)])
      if (other != worst) edge = std::min(edge, (mesh.vertices[at(other)] - mesh.vertices[at(worst)]).norm());
  return fmt::format("a node {:.3g} mm above the wall, shortest edge {:.3g} um", 1e3 * mesh.vertices[at(worst)].z(),
                     1e6 * edge);
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
  SanityInput input = material_input(config);
  input.diameter = particle.diameter;
  input.volume = particle.quality.total_volume;
  input.contact_element_size = particle.contact_element_size;
  input.element_size = particle.element_size;
  input.num_tets = particle.mesh.num_tets();
  return input;
}

}  // namespace

SanityCard estimated_card(const RunConfig& config, const Shape& shape) {
  SanityInput input = material_input(config);
  input.volume = volume(shape);
  input.diameter = volume_diameter(input.volume);
  input.contact_element_size = config.particles[0].mesh.contact_element_size;
  input.element_size = config.particles[0].mesh.element_size;
  input.num_tets = static_cast<Index>(expected_num_tets(shape, mesh_options(config.particles[0].mesh, shape)));
  return card_with_estimated_step(config, std::move(input));
}

SanityCard mesh_card(const RunConfig& config, const ParticleMesh& particle) {
  return card_with_estimated_step(config, mesh_input(config, particle));
}

SanityCard run_card(const RunConfig& config, const ParticleMesh& particle, const Simulation& s) {
  SanityInput input = mesh_input(config, particle);
  input.time_step = {s.clock.dt, step_limit(s, particle.mesh)};
  const bool timed = s.topology.num_tets() <= most_tets_to_copy;
  return card_with_cost(input, timed ? measured_elastic_cost(s) : elastic_cost / num_threads());
}

RunLimits run_limits(const SanityCard& card) {
  if (card.input.end_time) return {.end_time = *card.input.end_time, .automatic = false};
  return {.end_time = latest_end(card), .automatic = true, .quiet_time = quiet_crossings * card.crossing_time};
}

}  // namespace knap
