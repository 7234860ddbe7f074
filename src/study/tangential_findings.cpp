#include "study/tangential_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "study/mean_curve.hpp"

namespace knap {
namespace {

using Json = nlohmann::ordered_json;

// Spent on cracks, their friction and their closing [J].
double energy_of_breaking(const StudyRun& run) {
  return run.number("energy.reference") * (run.number("energy.cohesive_dissipated") +
                                           run.number("energy.crack_friction") + run.number("energy.closure_impact"));
}

// Differences of lost mass that count as none: an intact particle may lose as much.
constexpr double negligible = 1e-3;

/// A response at one normal speed over the tangential one, and the slope.
struct TangentialEffect {
  std::vector<double> tangential{}, value{};
  std::vector<Interval> interval{};
  double slope = 0.0;  // [s/m]
  Interval slope_interval{};
};

double slope_of(const std::vector<double>& x, const std::vector<double>& y) {
  double xx = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean(x)) * (x[i] - mean(x));
    xy += (x[i] - mean(x)) * (y[i] - mean(y));
  }
  return xy / xx;
}

TangentialEffect tangential_effect(const Study& study, const Series& series, const std::string& response,
                                   double normal) {
  constexpr int samples = 300;
  TangentialEffect effect;
  std::vector<std::vector<double>> drawn(samples);
  for (const double angle : angles_of(series)) {
    const std::vector<Condition> list = at_angle(series, angle);
    const double speed = normal / std::sin(angle);
    const double value = MeanCurve(study, list, runs_of(list), response).at(speed);
    if (std::isnan(value)) continue;
    effect.tangential.push_back(speed * std::cos(angle));
    effect.value.push_back(value);
    std::vector<double> values;
    const auto draws = drawn_conditions(list, samples);
    for (std::size_t k = 0; k < draws.size(); ++k) {
      values.push_back(MeanCurve(study, list, draws[k], response).at(speed));
      drawn[k].push_back(values.back());
    }
    effect.interval.push_back(central_95(values));
  }
  if (effect.value.size() < 3) return effect;
  effect.slope = slope_of(effect.tangential, effect.value);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  effect.slope_interval = {nan, nan};
  if (!has_repeats(series.conditions)) {
    for (Interval& interval : effect.interval) interval = {nan, nan};
    return effect;
  }
  std::vector<double> slopes;
  for (const auto& values : drawn) slopes.push_back(slope_of(effect.tangential, values));
  effect.slope_interval = central_95(slopes);
  return effect;
}

}  // namespace

void add_tangential(Findings& findings, const Study& study, const Series& series,
                    const std::vector<double>& normal_speeds, const std::string& suffix, Json& json) {
  PageSection section{.title = titled("Effect of the tangential velocity", series)};
  section.paragraphs.push_back(
      "At one normal velocity, under all angles: between the speeds that were run by straight lines of the logarithms. "
      "The slope is that of a straight line, its interval 95 % by bootstrap.");
  for (const std::string response : responses) {
    PlotInput plot{.title = titled(words(response) + " at fixed normal velocity", series),
                   .x_label = "tangential velocity [m/s]",
                   .y_label = words(response) + " [-]"};
    for (const double normal : normal_speeds) {
      const TangentialEffect effect = tangential_effect(study, series, response, normal);
      if (effect.value.size() < 3) continue;
      PlotSeries points{.name = fmt::format("{:g} m/s towards the wall", normal),
                        .x = effect.tangential,
                        .y = effect.value,
                        .style = PlotSeries::Style::Points};
      for (const Interval& interval : effect.interval)
        if (std::isfinite(interval.low)) points.low.push_back(interval.low), points.high.push_back(interval.high);
      plot.series.push_back(points);
      const double range = *std::max_element(effect.value.begin(), effect.value.end()) -
                           *std::min_element(effect.value.begin(), effect.value.end());
      const std::string answer = range < negligible                      ? "no effect, below 0.1 % of the mass"
                                 : std::isnan(effect.slope_interval.low) ? "not told without repeats"
                                 : effect.slope_interval.low > 0.0       ? "rises with the tangential velocity"
                                 : effect.slope_interval.high < 0.0      ? "falls with the tangential velocity"
                                                                         : "no effect beyond the scatter";
      Json one{{"measure", response},
               {"normal_speed", normal},
               {"slope_s_per_m", json_of(effect.slope)},
               {"slope_interval", json_of(effect.slope_interval)},
               {"range", range},
               {"verdict", answer}};
      for (std::size_t i = 0; i < effect.value.size(); ++i)
        one["points"].push_back({{"tangential_speed", effect.tangential[i]},
                                 {"mean", effect.value[i]},
                                 {"interval", json_of(effect.interval[i])}});
      json["tangential_effect"].push_back(one);
      section.rows.push_back({fmt::format("{} at {:g} m/s towards the wall", words(response), normal),
                              fmt::format("{:.2g} per m/s", effect.slope), shown(effect.slope_interval),
                              fmt::format("{}; values differ by {:.2g}", answer, range)});
      findings.verdicts.push_back(fmt::format("{}: {} at {:g} m/s towards the wall: {} (values differ by {:.2g}).",
                                              titled("Tangential velocity", series), words(response), normal, answer,
                                              range));
    }
    join_points(plot);
    add_figure(findings, section, fmt::format("tangential_{}{}", response, suffix), plot, "");
  }
  if (!section.rows.empty()) findings.sections.push_back(std::move(section));
}

// Without friction the wall cannot tell the tangential velocity: runs of one mesh and seed with the same v sin th are
// the same run seen from a moving frame.
void add_frictionless(Findings& findings, const Study& study, const Series& series, Json& json) {
  constexpr double same = 1e-9;  // of chipping ratios
  // By normal velocity, then mesh and seed: the steepest angle last.
  std::map<double, std::map<std::string, std::vector<const StudyRun*>>> alike;
  for (const Condition& condition : series.conditions)
    for (const std::size_t i : condition.runs) {
      const StudyRun& run = study.runs[i];
      alike[normal_speed(run.speed, run.angle)][run.mesh + run.seed].push_back(&run);
    }
  PageSection section{.title = titled("A wall without friction", series)};
  section.paragraphs.push_back(
      "Without friction damage depends on v sin θ only (the tangential part is a rigid translation): an exact check, "
      "run by run against the steepest angle with the same mesh and seed. Round-off parts runs once cracks branch: "
      "then the last bridge between two pieces breaks or not, while the energy that breaking takes stays the same.");
  for (const auto& [normal, by_mesh] : alike) {
    int pairs = 0, equal = 0;
    double largest = 0.0, largest_energy = 0.0;
    for (const auto& [mesh, runs] : by_mesh)
      for (std::size_t k = 0; k + 1 < runs.size(); ++k) {
        const double difference = std::abs(runs[k]->chipping_ratio() - runs.back()->chipping_ratio());
        const double energy = energy_of_breaking(*runs.back());
        ++pairs;
        if (difference < same) ++equal;
        largest = std::max(largest, difference);
        const double change = std::abs(energy_of_breaking(*runs[k]) / energy - 1.0);
        largest_energy = std::isnan(change) ? change : std::max(largest_energy, change);
      }
    if (pairs == 0) continue;
    json["frictionless_identity"].push_back({{"normal_speed", normal},
                                             {"pairs", pairs},
                                             {"equal_to_1e-9", equal},
                                             {"largest_difference", largest},
                                             {"largest_relative_difference_of_energy", json_of(largest_energy)}});
    const std::string text =
        equal == pairs
            ? fmt::format("all {} pairs have the same chipping ratio to 1e-9", pairs)
            : fmt::format("{} of {} pairs have the same chipping ratio to 1e-9, others differ by up to {:.2g}", equal,
                          pairs, largest);
    section.rows.push_back({fmt::format("energy of breaking at {:.4g} m/s towards the wall differs by", normal),
                            shown(100.0 * largest_energy) + " %", "", text});
    findings.verdicts.push_back(
        fmt::format("{} at {:.4g} m/s towards the wall: {}; the energy of breaking by up to {} %.",
                    titled("No friction", series), normal, text, shown(100.0 * largest_energy)));
  }
  if (!section.rows.empty()) findings.sections.push_back(std::move(section));
}

}  // namespace knap
