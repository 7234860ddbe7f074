// The critical speed of small and large granules: v_c ~ d^-x, with x from 0 where strength governs (d << l_ch) to 0.42
// where the energy of a crack does (d >> l_ch), physics.md section 3.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "validation/problems.hpp"
#include "validation/support/granule_study.hpp"

namespace knap {
namespace {

constexpr double characteristic_length = 323.5e-6;  // of the zeolite [m]

// Lowest speed [m/s] at which half of the incident energy does not come back as rebound, in steps of 4 %.
double critical_speed(GranuleStudy& study, double ratio) {
  const double diameter = ratio * characteristic_length;
  const double size = std::min(diameter / 12.0, 0.35 * characteristic_length);
  double low = 4.0, high = ratio < 0.5 ? 256.0 : 64.0;
  while (high / low > 1.04) {
    const double speed = std::sqrt(low * high);
    const GranuleOutcome outcome = study.at_parameters({ratio, speed}, [&] {
      return granule_case({.diameter = diameter,
                           .element_size = size,
                           .contact_element_size = 0.75 * size,
                           .contact_extent = 0.25 * diameter,
                           .speed = speed,
                           .end_time = 17e-6 * diameter / 1e-3});
    });
    (outcome.restitution < 0.5 ? high : low) = speed;
  }
  return std::sqrt(low * high);
}

}  // namespace

void show_size_effect(Evidence& evidence) {
  constexpr std::array<double, 7> ratios{0.125, 0.25, 0.5, 1.0, 2.0, 4.0, 7.0};
  GranuleStudy study(evidence.folder() / "study.csv", {"d over l_ch [-]", "speed [m/s]"}, evidence.keeps_runs());
  std::vector<double> x, speeds, exponents;
  for (const double ratio : ratios) {
    x.push_back(ratio);
    speeds.push_back(critical_speed(study, ratio));
    fmt::print("d/l_ch = {}: {:.3g} m/s\n", ratio, speeds.back());
  }
  for (std::size_t i = 1; i < x.size(); ++i)
    exponents.push_back(-std::log(speeds[i] / speeds[i - 1]) / std::log(x[i] / x[i - 1]));
  evidence.between("exponent at the smallest sizes [-]", exponents.front(), -0.1, 0.2, "0 for d << l_ch");
  evidence.between("exponent at the largest sizes [-]", exponents.back(), 0.1, 0.5, "towards 0.42 for d >> l_ch");
  evidence.at_least("growth of the exponent with size [-]", exponents.back() - exponents.front(), 0.0,
                    "from 0 to 0.42");
  std::vector<double> rule;
  for (const double ratio : x) rule.push_back(speeds.back() * std::pow(ratio / x.back(), -0.42));
  exponents.insert(exponents.begin(), exponents.front());
  study.tell_kept(evidence);
  evidence.curve(
      {{"d over l_ch [-]", x}, {"critical speed [m/s]", speeds}, {"exponent from the size before [-]", exponents}});
  evidence.plot(
      {.title = "Critical speed of zeolite granules of different sizes",
       .x_label = "diameter over characteristic length [-]",
       .y_label = "critical speed [m/s]",
       .series = {{"Knap", x, speeds, PlotSeries::Style::Points}, {"d^-0.42", x, rule, PlotSeries::Style::Dashes}},
       .log_x = true,
       .log_y = true});
}

}  // namespace knap
