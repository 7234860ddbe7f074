#include "analysis/hertz.hpp"

#include <cmath>
#include <numbers>

namespace knap {

double largest_approach(const HertzImpact& impact) {
  const double radius = 0.5 * impact.diameter;
  const double mass = std::numbers::pi / 6.0 * impact.density * std::pow(impact.diameter, 3);
  return std::pow(15.0 * mass * impact.speed * impact.speed / (16.0 * impact.reduced_modulus * std::sqrt(radius)), 0.4);
}

double peak_force(const HertzImpact& impact) {
  return 4.0 / 3.0 * impact.reduced_modulus * std::sqrt(0.5 * impact.diameter) *
         std::pow(largest_approach(impact), 1.5);
}

double contact_radius(const HertzImpact& impact) { return std::sqrt(0.5 * impact.diameter * largest_approach(impact)); }

double contact_time(const HertzImpact& impact) {
  return impact.speed > 0.0 ? 2.9433 * largest_approach(impact) / impact.speed : 0.0;
}

double critical_speed(const HertzImpact& impact, double strength) {
  HertzImpact unit = impact;  // F / d^2 goes with v^(6/5) and not with d: solve from its value at 1 m/s and 1 m
  unit.speed = 1.0;
  unit.diameter = 1.0;
  return std::pow(strength / (0.9 * peak_force(unit)), 5.0 / 6.0);
}

}  // namespace knap
