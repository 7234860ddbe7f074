// Galilean invariance: on a frictionless wall the tangential part of an oblique impact is a translation that nothing
// notices, so impacts of equal v sin(theta) are one and the same. They agree until round-off, which differs with the
// velocity, has grown to a facet's decision.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "tests/support/granule.hpp"
#include "validation/problems.hpp"
#include "validation/support/checked_step.hpp"

namespace knap {
namespace {

constexpr double normal_speed = 20.0;

Simulation impact(double angle_deg, double element_size) {
  Granule granule{.element_size = 0.2e-3, .contact_element_size = element_size};
  granule.particle.fracture = zeolite_fracture();
  granule.options.tools = {wall()};
  const double tangential = normal_speed / std::tan(angle_deg * std::numbers::pi / 180.0);
  granule.particle.velocity = {angle_deg == 90.0 ? 0.0 : tangential, 0.0, -normal_speed};
  return make_granule(granule);
}

double largest_difference(const Simulation& a, const Simulation& b) {
  const Vec3 frame = b.options.particles[0].velocity - a.options.particles[0].velocity;
  double largest = 0.0;
  for (Index i = 0; i < std::min(a.nodes.size(), b.nodes.size()); ++i)
    largest = std::max(largest, (xyz(b.nodes.v[at(i)]) - frame - xyz(a.nodes.v[at(i)])).norm() / normal_speed);
  return largest;
}

}  // namespace

void show_frictionless_oblique(Evidence& evidence) {
  const double size = evidence.is_short() ? 0.12e-3 : 0.09e-3;
  constexpr std::array<double, 3> angles{60.0, 45.0, 30.0};
  Simulation normal = impact(90.0, size);
  std::vector<Simulation> oblique;
  std::vector<PlotSeries> series;
  for (const double angle : angles) {
    oblique.push_back(impact(angle, size));
    series.push_back({fmt::format("{} deg", angle)});
  }
  std::array<double, angles.size()> largest{};
  while (normal.clock.time() < 2.5e-6) {
    checked_step(normal);
    for (std::size_t i = 0; i < angles.size(); ++i) {
      checked_step(oblique[i]);
      largest[i] = std::max(largest[i], largest_difference(normal, oblique[i]));
      series[i].x.push_back(1e6 * normal.clock.time());
      series[i].y.push_back(largest[i]);
    }
  }
  std::vector<Column> columns{{"time [us]", series[0].x}};
  for (std::size_t i = 0; i < angles.size(); ++i) {
    double different = 0.0;
    for (std::size_t f = 0; f < normal.topology.facet_state.size(); ++f)
      different += normal.topology.facet_state[f] != oblique[i].topology.facet_state[f];
    evidence.at_most(fmt::format("facets in another state at {} deg", angles[i]), different, 0.0, "exact invariance");
    evidence.at_most(fmt::format("difference of velocities at {} deg over the speed [-]", angles[i]), largest[i], 1e-7,
                     "round-off 1e-16, multiplied by some 1e8 in cracking");
    columns.push_back({series[i].name + " [-]", series[i].y});
  }
  evidence.at_least("facets cracked by then", static_cast<double>(normal.totals.inserted_facets), 300.0,
                    "enough to compare");
  evidence.curve(columns);
  evidence.plot({.title = "Impacts of equal normal speed on a frictionless wall",
                 .x_label = "time [us]",
                 .y_label = "largest difference of velocities over the speed [-]",
                 .series = series,
                 .log_y = true});
}

}  // namespace knap
