#include "validation/support/sphere_impact.hpp"

#include <cmath>
#include <numbers>

#include "validation/support/checked_step.hpp"

namespace knap {

HertzOutcome hertz_impact(double mass, double speed, double reduced_modulus, double radius) {
  HertzOutcome impact;
  impact.approach = std::pow(15.0 * mass * speed * speed / (16.0 * reduced_modulus * std::sqrt(radius)), 0.4);
  impact.force = 4.0 / 3.0 * reduced_modulus * std::sqrt(radius) * std::pow(impact.approach, 1.5);
  impact.duration = 2.9433 * impact.approach / speed;
  return impact;
}

// With the largest approach 1 and the speed 1, x'' = -(5/4) x^(3/2); by the midpoint rule.
std::vector<double> hertz_force(const std::vector<double>& times) {
  constexpr int steps = 20000;
  constexpr double dt = 2.9433 / steps;
  std::vector<double> force(steps + 1, 0.0);
  double x = 0.0, v = 1.0;
  for (std::size_t i = 0; i <= steps; ++i) {
    force[i] = std::pow(std::max(x, 0.0), 1.5);
    const double middle = x + 0.5 * dt * v;
    v -= dt * 1.25 * std::pow(std::max(middle, 0.0), 1.5);
    x = middle + 0.5 * dt * v;
  }
  std::vector<double> result;
  for (const double time : times)
    result.push_back(time <= 0.0 || time >= 1.0 ? 0.0 : force[static_cast<std::size_t>(time * steps)]);
  return result;
}

double SphereImpact::reduced_modulus() const {
  return Granule{}.particle.young_modulus / (1.0 - poisson_ratio * poisson_ratio);
}

double SphereImpact::speed() const { return std::sqrt(group * reduced_modulus() / Granule{}.particle.density); }

double SphereImpact::contact_radius() const { return radius() * std::pow(1.25 * std::numbers::pi * group, 0.2); }

Simulation make_impact(const SphereImpact& impact) {
  Granule granule{.diameter = 2.0 * impact.radius(),
                  .element_size = 0.7 / impact.elements * impact.radius(),
                  .contact_element_size = impact.contact_radius() / impact.elements,
                  .contact_extent = 2.4 * impact.contact_radius()};
  granule.particle.poisson_ratio = impact.poisson_ratio;
  granule.particle.velocity = impact.speed() * Vec3(impact.tangential_speed, 0.0, -1.0);
  granule.options.tools = {wall(impact.friction)};
  granule.options.step_safety = impact.step_safety;
  return make_granule(granule);
}

ForceHistory follow_force(Simulation& s, double end, double window) {
  ForceHistory history;
  const auto interval = std::max<std::int64_t>(1, std::llround(window / s.clock.dt));
  const double span = static_cast<double>(interval) * s.clock.dt;
  const double speed = momentum(s.nodes).velocity().z();
  const ToolState& wall = s.tools[0].state;
  while (s.clock.time() < end) {
    const double before = wall.impulse.z();
    for (std::int64_t i = 0; i < interval; ++i) checked_step(s);
    if (wall.first_step < 0) continue;
    history.time.push_back(s.clock.time() - 0.5 * span - static_cast<double>(wall.first_step) * s.clock.dt);
    history.force.push_back((wall.impulse.z() - before) / span);
  }
  history.duration = static_cast<double>(wall.last_step - wall.first_step) * s.clock.dt;
  history.restitution = -momentum(s.nodes).velocity().z() / speed;
  return history;
}

}  // namespace knap
