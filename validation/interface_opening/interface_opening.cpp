// Two half-bars under uniform stress sigma0 above the strength part at their interface; each side radiates waves of
// impedance rho c, so that
//   opening = delta_c (sigma0/sigma_c - 1)(exp(t/tau) - 1),   tau = rho c G_c/sigma_c^2,
// until they are free at tau ln(1 + 1/(sigma0/sigma_c - 1)): linear softening against two impedances, exact.
#include "simulation/initial_cracks.hpp"
#include "validation/problems.hpp"
#include "validation/support/bar.hpp"
#include "validation/support/checked_step.hpp"

namespace knap {
namespace {

constexpr double modulus = 1e9, density = 1000.0, strength = 1e6, fracture_energy = 2.0;

struct Opening {
  std::vector<double> time;     // over tau [-]
  std::vector<double> opening;  // over delta_c [-]
  double free_after = 0.0;      // over tau [-]
};

double mean_opening(const Simulation& s) {
  double sum = 0.0;
  for (const CrackRecord& record : s.cracks.records)
    sum += s.nodes.x[at(record.node_b)].x() - s.nodes.x[at(record.node_a)].x();
  return std::abs(sum) / static_cast<double>(s.cracks.records.size());
}

// Until the sides are free; the bar is so long that the release waves of its ends come later.
Opening part(double overload, Index cells) {
  BarOptions bar{.young_modulus = modulus,
                 .density = density,
                 .strength = 1e3 * strength,  // but for the interface
                 .fracture_energy = fracture_energy,
                 .cells = cells};
  bar.cell = 6.0 * modulus * fracture_energy / (strength * strength) / cells;
  Simulation s = make_bar(bar);
  const double strain = overload * strength / modulus;
  set_bar_in_motion(
      s, [&](double x) { return strain * x; }, [](double) { return 0.0; });
  std::vector<InitialCrack> interface;
  for (Index f = 0; f < s.topology.num_facets(); ++f)
    if (plane_of_facet(s, bar, f) == cells / 2) interface.push_back({.facet = f, .strength = strength});
  open_initial_cracks(s, interface);
  const double tau = density * bar.wave_speed() * fracture_energy / (strength * strength);
  const double delta_c = 2.0 * fracture_energy / strength;
  Opening result;
  while (result.free_after == 0.0) {
    result.time.push_back(s.clock.time() / tau);
    result.opening.push_back(mean_opening(s) / delta_c);
    if (result.opening.back() >= 1.0) result.free_after = result.time.back();
    checked_step(s);
  }
  return result;
}

double exact_opening(double overload, double time) { return (overload - 1.0) * std::expm1(time); }

}  // namespace

void show_interface_opening(Evidence& evidence) {
  const CsvColumns reference = evidence.reference();
  const Index cells = evidence.is_short() ? 240 : 480;
  std::vector<PlotSeries> series;
  std::vector<Column> columns;
  const std::string why = "physics.md 3; the step takes dt/tau of the opening at the start, the cell e/l_ch";
  for (const std::string overload : {"1.1", "1.3", "2.0"}) {
    const double ratio = std::stod(overload);
    const Opening run = part(ratio, cells);
    double largest = 0.0;
    for (std::size_t i = 0; i < run.time.size(); ++i)
      largest = std::max(largest, std::abs(run.opening[i] - exact_opening(ratio, run.time[i])));
    evidence.at_most("opening error over delta_c, overload " + overload + " [-]", largest, 0.02, why);
    evidence.relative("time to full opening over tau, overload " + overload + " [-]", run.free_after,
                      std::log(1.0 + 1.0 / (ratio - 1.0)), 0.02, why);
    PlotSeries points{.name = "overload " + overload, .style = PlotSeries::Style::Points};
    for (int k = 0; k <= 25; ++k) {
      const auto i = static_cast<std::size_t>(k) * (run.time.size() - 1) / 25;
      points.x.push_back(run.time[i]), points.y.push_back(run.opening[i]);
    }
    columns.push_back({"time over tau, overload " + overload + " [-]", points.x});
    columns.push_back({"opening over delta_c, overload " + overload + " [-]", points.y});
    series.push_back(points);
    series.push_back({.name = overload == "2.0" ? "exact" : "",
                      .x = reference.column("time_over_tau_" + overload),
                      .y = reference.column("opening_over_delta_c_" + overload),
                      .style = PlotSeries::Style::Dashes});
  }
  evidence.curve(columns);
  evidence.plot({.title = "Opening of one interface between two half-bars",
                 .x_label = "time over tau = rho c G_c/sigma_c^2 [-]",
                 .y_label = "opening over delta_c [-]",
                 .series = series});
}

}  // namespace knap
