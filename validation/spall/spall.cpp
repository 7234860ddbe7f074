// A compressive pulse comes back from the free end of a bar as tension: a square one breaks the bar at half its length
// from the end, a triangular one (steep front, peak sigma_m, length lambda) first at lambda sigma_c/(2 sigma_m), where
// the tension first reaches the strength. A crack takes l_ch/c to open, in which the wave goes l_ch: that is the
// accuracy of "where".
#include <fmt/format.h>

#include <optional>

#include "validation/problems.hpp"
#include "validation/support/bar.hpp"
#include "validation/support/checked_step.hpp"

namespace knap {
namespace {

constexpr double pulse_length = 1.0;      // [m]
constexpr double front_length = 0.05;     // of many cells: sharper ones ring [m]
constexpr double characteristic = 0.01;   // l_ch [m]
constexpr double strain_at_break = 1e-4;  // small: the law is linear

enum class Pulse { Square, Triangle };

// Compression over the peak at a distance behind the front's foot. A triangular pulse falls over its length behind the
// peak, a square one is as long between its half heights.
double shape(Pulse pulse, double behind) {
  if (behind <= 0.0 || behind >= pulse_length + front_length) return 0.0;
  const double front = std::min(1.0, behind / front_length), left = pulse_length + front_length - behind;
  return pulse == Pulse::Triangle ? std::min(front, left / pulse_length) : std::min(front, left / front_length);
}

// Its integral from the end of the pulse to `behind` [m].
double displacement(Pulse pulse, double behind) {
  constexpr int parts = 1000;
  const double end = pulse_length + front_length;
  if (behind >= end) return 0.0;
  const double from = std::max(0.0, behind), width = (end - from) / parts;
  double sum = 0.0;
  for (int i = 0; i < parts; ++i) sum += shape(pulse, from + (i + 0.5) * width) * width;
  return sum;
}

struct Spall {
  double first_crack = 0.0;  // distance of the first inserted plane from the free end [m]
  double first_break = 0.0;  // of the first plane that failed [m]
  double closure_error = 0.0;
};

// Distance from the free end of the middle of the planes with a state.
std::optional<double> place_of(const Simulation& s, const BarOptions& bar, bool failed) {
  double sum = 0.0;
  int count = 0;
  for (Index f = 0; f < s.topology.num_facets(); ++f) {
    const FacetState state = s.topology.facet_state[at(f)];
    if (state == FacetState::Bonded || (failed && state == FacetState::Cohesive)) continue;
    sum += bar.length() - bar.cell * plane_of_facet(s, bar, f);
    ++count;
  }
  if (count == 0) return {};
  return sum / count;
}

Spall spall(Pulse pulse, double overload, Index cells_per_pulse) {
  // Units in which E = rho = c = 1.
  BarOptions bar{.strength = strain_at_break};
  bar.fracture_energy = characteristic * bar.strength * bar.strength;
  bar.cells = 5 * cells_per_pulse / 2;
  bar.cell = pulse_length / cells_per_pulse;
  Simulation s = make_bar(bar);
  const double front = bar.length() - 2.0 * bar.cell, peak = overload * strain_at_break;
  // Moving to +x; the velocity is that half a step before, when the pulse was further back.
  const double back = 0.5 * s.clock.dt;
  set_bar_in_motion(
      s, [&](double x) { return -peak * displacement(pulse, front - x); },
      [&](double x) { return peak * shape(pulse, front - back - x); });
  Spall result;
  while (s.clock.time() < 2.0 * pulse_length && result.first_break == 0.0) {
    checked_step(s);
    if (result.first_crack == 0.0) result.first_crack = place_of(s, bar, false).value_or(0.0);
    if (s.clock.step % 16 == 0) result.first_break = place_of(s, bar, true).value_or(0.0);
  }
  result.closure_error = s.ledger.max_closure_error;
  return result;
}

}  // namespace

void show_spall(Evidence& evidence) {
  const Index cells = evidence.is_short() ? 400 : 800;
  const double tolerance = 2.0 * characteristic / pulse_length + 0.01;
  const std::string why = "2 l_ch for the time that opening takes, and a hundredth for cells and front, over the pulse";
  const Spall square = spall(Pulse::Square, 1.5, cells);
  evidence.absolute("square pulse: first crack from the end over the length [-]", square.first_crack, 0.5, tolerance,
                    why);
  evidence.absolute("square pulse: first break from the end over the length [-]", square.first_break, 0.5, tolerance,
                    why);
  double closure = square.closure_error;
  PlotSeries cracks{.name = "first crack", .style = PlotSeries::Style::Points};
  PlotSeries exact{.name = "sigma_c/(2 sigma_m)", .style = PlotSeries::Style::Dashes};
  Column breaks{"first break from the end over the length [-]", {}};
  for (const double overload : {1.25, 1.5, 2.0, 3.0}) {
    const Spall run = spall(Pulse::Triangle, overload, cells);
    const std::string name = fmt::format("triangle, peak {:.2f} sigma_c: ", overload);
    evidence.absolute(name + "first crack over the length [-]", run.first_crack, 0.5 / overload, tolerance, why);
    evidence.tell(name + "first break over the length [-]", run.first_break,
                  "the wave goes on while the first crack opens, and what it meets then opens faster");
    cracks.x.push_back(overload), cracks.y.push_back(run.first_crack);
    breaks.values.push_back(run.first_break);
    closure = std::max(closure, run.closure_error);
  }
  for (int k = 0; k <= 40; ++k) {
    const double overload = 1.1 + 0.05 * k;
    exact.x.push_back(overload), exact.y.push_back(0.5 / overload);
  }
  evidence.at_most("energy closure error [-]", closure, 0.01, "physics.md 3");
  evidence.curve({{"peak over strength [-]", cracks.x}, {"first crack over the length [-]", cracks.y}, breaks});
  evidence.plot({.title = "Spall by a triangular pulse",
                 .x_label = "peak stress over strength [-]",
                 .y_label = "first crack from the free end over the pulse's length [-]",
                 .series = {cracks, exact}});
}

}  // namespace knap
