// A block thrown along a wall under gravity: it stops after the distance v^2/(2 mu g) and the time v/(mu g), and
// friction has then done the work of all its kinetic energy. Soft and damped; it first settles on a wall without
// friction.
#include <cmath>

#include "simulation/make_simulation.hpp"
#include "tests/support/bar_mesh.hpp"
#include "validation/problems.hpp"
#include "validation/support/checked_step.hpp"

namespace knap {
namespace {

constexpr double g = 9.81, speed = 0.5;  // [m/s2], [m/s]

/// The way of the centre over time since it was thrown, and what friction has taken.
struct Slide {
  std::vector<double> time{}, way{}, velocity{};  ///< [s], [m], [m/s]
  double friction_work = 0.0, kinetic = 0.0;      ///< [J]
  double stops_after = 0.0;                       ///< [s]
};

Slide slide(double friction) {
  const ParticleOptions rubber{
      .young_modulus = 1e6, .poisson_ratio = 0.25, .density = 1000.0, .viscous_ratio = 0.5, .relaxation_time = 2e-3};
  Simulation s = make_simulation({.particles = {rubber}, .tools = {wall(0.0)}, .gravity = {0.0, 0.0, -g}},
                                 bar_mesh({4, 4, 1}, 5e-3));  // flat, so that it does not tip
  while (s.clock.time() < 0.1) checked_step(s);
  for (Vec4& v : s.nodes.v) v.x() += speed;
  s.tools[0].friction = s.options.tools[0].friction = friction;
  balance_from_here(s);
  Slide result{.kinetic = 0.5 * s.reference.start.mass * speed * speed};
  const double start = s.clock.time(), from = momentum(s.nodes).centre().x();
  const double friction_before = s.tools[0].state.friction_loss;
  while (s.clock.time() - start < 1.3 * speed / (friction * g)) {
    for (int i = 0; i < 10; ++i) checked_step(s);
    const Momentum now = momentum(s.nodes);
    result.time.push_back(s.clock.time() - start);
    result.way.push_back(now.centre().x() - from);
    result.velocity.push_back(now.velocity().x());
    if (now.velocity().x() > 0.01 * speed) result.stops_after = result.time.back();
  }
  result.friction_work = s.tools[0].state.friction_loss - friction_before;
  return result;
}

}  // namespace

void show_sliding_block(Evidence& evidence) {
  const double friction = 0.3, distance = speed * speed / (2.0 * friction * g), time = speed / (friction * g);
  const Slide found = slide(friction);
  const std::string why = "shear of the block, its rocking when thrown: thousandths";
  evidence.relative("distance to rest over v^2/(2 mu g) [-]", found.way.back() / distance, 1.0, 0.01, why);
  evidence.relative("time to 1 % of the speed over 0.99 v/(mu g) [-]", found.stops_after / (0.99 * time), 1.0, 0.01,
                    why);
  evidence.relative("work of friction over the kinetic energy [-]", found.friction_work / found.kinetic, 1.0, 0.01,
                    "the rest is in damped vibrations");
  evidence.at_most("speed at the end over the start [-]", std::abs(found.velocity.back()) / speed, 1e-4, "it sticks");
  std::vector<double> exact;
  for (const double t : found.time) {
    const double moving = std::min(t, time);
    exact.push_back(speed * moving - 0.5 * friction * g * moving * moving);
  }
  evidence.curve(
      {{"time [s]", found.time}, {"way [m]", found.way}, {"velocity [m/s]", found.velocity}, {"exact way [m]", exact}});
  evidence.plot(
      {.title = "A block that slides to rest, mu = 0.3",
       .x_label = "time [s]",
       .y_label = "way [m]",
       .series = {{"Knap", found.time, found.way}, {"Coulomb", found.time, exact, PlotSeries::Style::Dashes}}});
}

}  // namespace knap
