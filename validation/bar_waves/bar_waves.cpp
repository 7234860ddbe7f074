// A compressive pulse in a bar that does not strain sideways (nu = 0), where waves are exactly d'Alembert's: it leaves
// the middle for a wall, comes back, is reflected by the free end and comes back as tension. And a whole bar that
// strikes the wall: a pressure of rho c v for the time 2 L/c.
#include <cmath>
#include <numbers>

#include "simulation/make_simulation.hpp"
#include "tests/support/bar_mesh.hpp"
#include "validation/problems.hpp"
#include "validation/support/checked_step.hpp"

namespace knap {
namespace {

constexpr double modulus = 10e9, density = 2500.0;    // [Pa], [kg/m3]
constexpr double c0 = 2000.0;                         // sqrt(E/rho) [m/s]
constexpr double speed = 1e-4 * c0;                   // of the pulse's middle: strain 1e-4, Hooke's law [m/s]
constexpr double cell = 1e-3;                         // [m]
constexpr Index width = 2;                            // of the bar [cells]
constexpr double area = cell * cell * width * width;  // [m2]

Simulation bar_before_wall(Index cells, const Vec3& velocity) {
  const ParticleOptions bar{.young_modulus = modulus, .poisson_ratio = 0.0, .density = density, .velocity = velocity};
  return make_simulation({.particles = {bar}, .tools = {wall(0.0, Vec3::Zero(), Vec3::UnitX())}},
                         bar_mesh({cells, width, width}, cell));
}

/// A pulse of velocity as a cosine bell, going towards the wall.
struct Pulse {
  double middle = 0.0;  ///< at the start [m]
  double length = 0.0;  ///< [m]

  /// Over the speed in its middle [-].
  double shape(double x) const {
    const double s = (x - middle) / length;
    return std::abs(s) < 0.5 ? std::pow(std::cos(std::numbers::pi * s), 2) : 0.0;
  }
  /// Integral of the shape from the wall up to x [m].
  double area_before(double x) const {
    const double s = std::clamp((x - middle) / length, -0.5, 0.5);
    return length * (0.5 * (s + 0.5) + std::sin(2.0 * std::numbers::pi * s) / (4.0 * std::numbers::pi));
  }
};

void add_pulse(Simulation& s, const Pulse& pulse) {
  for (std::size_t i = 0; i < s.nodes.x.size(); ++i) {
    const double x = s.reference.vertices[i].x();
    s.nodes.x[i].x() -= speed / c0 * pulse.area_before(x);
    s.nodes.v[i].x() = -speed * pulse.shape(x - 0.5 * c0 * s.clock.dt);  // half a step earlier
  }
  s.nodes.v_before = s.nodes.v;
  update_elastic_forces(s.elastic, s.nodes.x, s.nodes.f, 0.0);
  balance_from_here(s);
}

/// What is measured over time, velocities over the pulse's, stresses over rho c0 times it.
struct Record {
  std::vector<double> time{};                ///< over L/c0 [-]
  std::vector<double> velocity{}, stress{};  ///< in the middle of the bar [-]
  std::vector<double> end{}, wall_stress{};  ///< velocity of the free end, stress at the wall [-]
};

double mean_velocity(const Simulation& s, double x) {
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < s.nodes.v.size(); ++i)
    if (std::abs(s.reference.vertices[i].x() - x) < 0.1 * cell) sum += s.nodes.v[i].x(), ++count;
  return sum / count;
}

// Of the two layers of cells around x.
double mean_stress(Simulation& s, double x) {
  update_stress(s.elastic, s.nodes.x);
  double sum = 0.0, count = 0.0;
  for (std::size_t t = 0; t < s.elastic.stress.size(); ++t) {
    double middle = 0.0;
    for (const Index v : s.topology.tet_vertices[t]) middle += 0.25 * s.reference.vertices[at(v)].x();
    if (std::abs(middle - x) < cell) sum += s.elastic.stress[t].xx, ++count;
  }
  return sum / count;
}

Record follow(Simulation& s, double length) {
  Record record;
  const auto interval = std::max<std::int64_t>(1, std::llround(cell / c0 / s.clock.dt));
  const double window = s.clock.dt * static_cast<double>(interval), impedance = density * c0 * speed;
  double impulse = 0.0;
  while (s.clock.time() < 2.6 * length / c0) {
    for (std::int64_t i = 0; i < interval; ++i) checked_step(s);
    record.time.push_back((s.clock.time() - 0.5 * window) * c0 / length);
    record.velocity.push_back(mean_velocity(s, 0.5 * length) / speed);
    record.end.push_back(mean_velocity(s, length) / speed);
    record.stress.push_back(mean_stress(s, 0.5 * length) / impedance);
    record.wall_stress.push_back(-(s.tools[0].state.impulse.x() - impulse) / (window * area * impedance));
    impulse = s.tools[0].state.impulse.x();
  }
  return record;
}

// d'Alembert: the pulse leaves the middle, is at the wall at 1/2, back at 1, at the free end at 3/2, back at 2.
Record exact(const Record& record, const Pulse& pulse, double length) {
  Record exact{.time = record.time};
  for (const double time : record.time) {
    const auto passing = [&](double when) {
      const Pulse at_rest{.length = pulse.length};
      return at_rest.shape((time - when) * length);
    };
    exact.velocity.push_back(-passing(0.0) + passing(1.0) + passing(2.0));
    exact.stress.push_back(-passing(0.0) - passing(1.0) + passing(2.0));
    exact.end.push_back(2.0 * passing(1.5));
    exact.wall_stress.push_back(-2.0 * passing(0.5));
  }
  return exact;
}

// When a pulse passes: the mean of the times, weighted with the values between two times.
double passage(const Record& record, double first, double last) {
  double sum = 0.0, moment = 0.0;
  for (std::size_t i = 0; i < record.time.size(); ++i)
    if (record.time[i] > first && record.time[i] < last)
      sum += record.velocity[i], moment += record.time[i] * record.velocity[i];
  return moment / sum;
}

double largest(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }
double smallest(const std::vector<double>& values) { return *std::min_element(values.begin(), values.end()); }

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double difference = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) difference = std::max(difference, std::abs(a[i] - b[i]));
  return difference;
}

void show_pulse(Evidence& evidence, Index cells) {
  const double length = cell * cells;
  const Pulse pulse{.middle = 0.5 * length, .length = 0.25 * length};
  Simulation s = bar_before_wall(cells, Vec3::Zero());
  add_pulse(s, pulse);
  const Record found = follow(s, length), expected = exact(found, pulse, length);
  const std::string dispersion = "the lattice slows waves of 60 elements, the length of the pulse, by 0.1 %";
  const double way_over_time = 1.0 / (passage(found, 1.5, 2.5) - passage(found, 0.5, 1.5));
  evidence.relative("wave speed over sqrt(E/rho) [-]", way_over_time, 1.0, 0.01, dispersion);
  evidence.relative("stress over rho c v [-]", smallest(found.stress), -1.0, 0.01, dispersion);
  evidence.relative("stress at the fixed end over that of the pulse [-]", smallest(found.wall_stress), -2.0, 0.01,
                    dispersion);
  evidence.relative("velocity of the free end over that of the pulse [-]", largest(found.end), 2.0, 0.01, dispersion);
  evidence.relative("stress after the free end over rho c v [-]", largest(found.stress), 1.0, 0.01, dispersion);
  const double error =
      std::max({largest_difference(found.velocity, expected.velocity),
                largest_difference(found.stress, expected.stress), 0.5 * largest_difference(found.end, expected.end),
                0.5 * largest_difference(found.wall_stress, expected.wall_stress)});
  evidence.at_most("largest difference from d'Alembert over the pulse [-]", error, 0.03,
                   "1 % of wave speed is 0.03 of a pulse of a quarter of the bar");
  evidence.curve({{"time c0/L [-]", found.time},
                  {"velocity middle [-]", found.velocity},
                  {"exact", expected.velocity},
                  {"stress middle [-]", found.stress},
                  {"exact", expected.stress},
                  {"velocity free end [-]", found.end},
                  {"exact", expected.end},
                  {"stress wall [-]", found.wall_stress},
                  {"exact", expected.wall_stress}});
  evidence.plot({.title = "Pulse in a bar: from the middle to the wall, the free end, and back",
                 .x_label = "time c0/L [-]",
                 .y_label = "velocity over v, stress over rho c0 v [-]",
                 .series = {{"velocity of the free end", found.time, found.end},
                            {"stress in the middle", found.time, found.stress},
                            {"stress at the wall", found.time, found.wall_stress},
                            {"d'Alembert, free end", found.time, expected.end, PlotSeries::Style::Dashes},
                            {"d'Alembert, middle", found.time, expected.stress, PlotSeries::Style::Dashes},
                            {"d'Alembert, wall", found.time, expected.wall_stress, PlotSeries::Style::Dashes}}});
}

// The front is as wide as the lattice makes it, and so is the time at which the wall lets go.
void show_struck_bar(Evidence& evidence, Index cells) {
  const double length = cell * cells;
  Simulation s = bar_before_wall(cells, {-speed, 0.0, 0.0});
  double impulse_early = 0.0, impulse_late = 0.0, early = 0.0, late = 0.0;
  while (s.clock.time() < 2.5 * length / c0) {
    checked_step(s);
    const double time = s.clock.time() * c0 / length, impulse = s.tools[0].state.impulse.x();
    if (time < 0.5) early = s.clock.time(), impulse_early = impulse;
    if (time < 1.5) late = s.clock.time(), impulse_late = impulse;
  }
  const double pressure = (impulse_late - impulse_early) / (late - early) / area;
  const std::string why = "0.5 % of the bar is the wall's layer of elements; the front adds its width";
  evidence.relative("pressure of a striking bar over rho c v [-]", pressure / (density * c0 * speed), 1.0, 0.01, why);
  const ToolState& wall = s.tools[0].state;
  const double duration = static_cast<double>(wall.last_step - wall.first_step) * s.clock.dt;
  evidence.relative("time on the wall over 2 L/c [-]", 0.5 * duration * c0 / length, 1.0, 0.03, why);
  evidence.relative("rebound over impact speed of the bar [-]", momentum(s.nodes).velocity().x() / speed, 1.0, 0.01,
                    why);
}

}  // namespace

void show_bar_waves(Evidence& evidence) {
  const Index cells = evidence.is_short() ? 240 : 480;
  show_pulse(evidence, cells);
  show_struck_bar(evidence, cells);
}

}  // namespace knap
