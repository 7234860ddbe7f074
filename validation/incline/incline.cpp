// A block of 20 mm on a wall inclined by `angle`, under gravity: it sticks up to the angle of friction and slides with
// g (sin - mu cos) above it. Soft and damped, so that it has come to rest before it is measured.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "simulation/make_simulation.hpp"
#include "tests/support/bar_mesh.hpp"
#include "validation/problems.hpp"
#include "validation/support/checked_step.hpp"

namespace knap {
namespace {

constexpr double g = 9.81, friction = 0.5;  // [m/s2], [-]

// Mean acceleration down the wall between 0.1 and 0.3 s, over g [-].
double acceleration(double angle) {
  const ParticleOptions rubber{
      .young_modulus = 1e6, .poisson_ratio = 0.25, .density = 1000.0, .viscous_ratio = 0.5, .relaxation_time = 2e-3};
  Simulation s = make_simulation(
      {.particles = {rubber}, .tools = {wall(friction)}, .gravity = g * Vec3(std::sin(angle), 0.0, -std::cos(angle))},
      bar_mesh({2, 2, 2}, 0.01));
  while (s.clock.time() < 0.1) checked_step(s);
  const double speed = momentum(s.nodes).velocity().x(), start = s.clock.time();
  while (s.clock.time() < 0.3) checked_step(s);
  return (momentum(s.nodes).velocity().x() - speed) / (s.clock.time() - start) / g;
}

}  // namespace

void show_incline(Evidence& evidence) {
  std::vector<double> ratios{0.5, 0.9, 0.98, 1.02, 1.1, 1.5, 2.5}, degrees, found, exact;
  for (const double ratio : ratios) {
    const double angle = std::atan(ratio * friction);
    degrees.push_back(angle * 180.0 / std::numbers::pi);
    found.push_back(acceleration(angle));
    exact.push_back(std::max(0.0, std::sin(angle) - friction * std::cos(angle)));
    const std::string name = fmt::format("tan/mu {}: acceleration over g [-]", ratio);
    if (ratio < 1.0) {
      evidence.absolute(name, found.back(), 0.0, 1e-6, "it sticks; what is left is the end of its settling");
    } else {
      const std::string why = "1 % of what moves it, against mu cos where that nearly cancels";
      evidence.absolute(name, found.back(), exact.back(), 0.01 * std::max(exact.back(), 0.1 * std::sin(angle)), why);
    }
  }
  std::vector<double> theory_angle, theory;
  for (double angle = 0.0; angle <= degrees.back() + 2.0; angle += 0.5) {
    const double a = angle * std::numbers::pi / 180.0;
    theory_angle.push_back(angle), theory.push_back(std::max(0.0, std::sin(a) - friction * std::cos(a)));
  }
  evidence.curve({{"angle [deg]", degrees}, {"acceleration over g [-]", found}, {"exact [-]", exact}});
  evidence.plot({.title = "A block on an incline, mu = 0.5",
                 .x_label = "angle [deg]",
                 .y_label = "acceleration over g [-]",
                 .series = {{"Knap", degrees, found, PlotSeries::Style::Points},
                            {"Coulomb", theory_angle, theory, PlotSeries::Style::Dashes}}});
}

}  // namespace knap
