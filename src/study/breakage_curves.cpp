#include "study/breakage_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "study/mean_curve.hpp"

namespace knap {
namespace {

using Json = nlohmann::ordered_json;

// The mean edge of the coarsest mesh [m].
double largest_element(const Study& study, const Series& series) {
  double size = 0.0;
  for (const Condition& condition : series.conditions)
    for (const std::size_t i : condition.runs) size = std::max(size, study.runs[i].element_size);
  return size;
}

void add_curves(Findings& findings, const Study& study, const Series& series, const std::string& suffix) {
  PageSection section{.title = titled("Breakage over speed and angle", series)};
  section.paragraphs.push_back(fmt::format(
      "Angles are from the plane of the wall: 90° is straight on. Points are means over meshes and seeds, bars their "
      "95 % intervals. Breakage ratio: the mass that passes a sieve of {}; chipping ratio: the mass outside "
      "the largest piece.",
      study.sieve > 0.0 ? fmt::format("{:.4g} mm", 1e3 * study.sieve) : "the particle's diameter over 2^(1/4)"));
  for (const std::string response : responses) {
    PlotInput plot = by_angle(study, series, response, [](const Condition& c) { return c.speed; });
    join_points(plot);
    plot.title = titled(words(response) + " over speed", series);
    plot.x_label = "impact speed [m/s]", plot.y_label = words(response) + " [-]";
    add_figure(findings, section, response + "_over_speed" + suffix, plot, "");
  }
  const auto over_angle = [&](const std::string& response) {
    PlotInput plot;
    std::set<double> speeds;
    for (const Condition& condition : series.conditions) speeds.insert(condition.speed);
    for (const double speed : speeds) {
      std::vector<Condition> list;
      for (const Condition& condition : series.conditions)
        if (condition.speed == speed) list.push_back(condition);
      if (list.size() > 2)
        plot.series.push_back(points_of(study, list, response, fmt::format("{:g} m/s", speed),
                                        [](const Condition& c) { return c.angle / degree; }));
    }
    if (plot.series.size() > 8) plot.series.erase(plot.series.begin(), plot.series.end() - 8);  // the faster ones
    join_points(plot);
    return plot;
  };
  if (const double floor = largest_element(study, series); study.sieve > 0.0 && study.sieve < floor) {
    const std::string warning = fmt::format(
        "The sieve of {:.4g} mm is finer than the mesh resolves, {:.4g} mm: the breakage ratio is the mesh's.",
        1e3 * study.sieve, 1e3 * floor);
    section.paragraphs.push_back(warning);
    findings.verdicts.push_back(titled("Breakage ratio", series) + ": " + warning);
  }
  PlotInput plot = over_angle("breakage_ratio");
  plot.title = titled("breakage ratio over angle", series);
  plot.x_label = "impact angle from the wall [deg]", plot.y_label = "breakage ratio [-]";
  add_figure(findings, section, "breakage_ratio_over_angle" + suffix, plot, "");
  findings.sections.push_back(std::move(section));
}

void add_thresholds(Findings& findings, const Study& study, const Series& series, Json& json) {
  const double steepest = angles_of(series).back();
  const std::vector<Condition> list = at_steepest_angle(series);
  if (list.size() < 3) return;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto draws = drawn_conditions(list, bootstrap_samples);
  PageSection section{.title = titled("Threshold", series)};
  for (const std::string response : responses)
    for (const double level : {0.01, 0.05, 0.1, 0.5}) {
      const double speed = MeanCurve(study, list, runs_of(list), response).speed_of(level);
      std::vector<double> speeds;
      for (const auto& draw : draws) speeds.push_back(MeanCurve(study, list, draw, response).speed_of(level));
      const Interval interval =
          has_repeats(list) ? Interval{quantile(speeds, 0.025), quantile(speeds, 0.975)} : Interval{nan, nan};
      json["thresholds"].push_back({{"measure", response},
                                    {"level", level},
                                    {"angle_deg", steepest / degree},
                                    {"speed", json_of(speed)},
                                    {"interval", json_of(interval)}});
      if (level == 0.01 && response == std::string("chipping_ratio") && std::isfinite(speed))
        findings.verdicts.push_back(fmt::format("{}: at {:.3g}° the mean loss reaches 1 % at {} m/s.",
                                                titled("Threshold", series), steepest / degree,
                                                shown(speed, interval)));
      section.rows.push_back({fmt::format("{} reaches {:g} at {:.3g}°", words(response), level, steepest / degree),
                              std::isfinite(speed) ? fmt::format("{:.3g} m/s", speed) : "not reached", shown(interval),
                              speed == list.front().speed ? "already at the slowest speed" : ""});
    }
  findings.sections.push_back(std::move(section));
}

}  // namespace

void add_breakage_curves(Findings& findings, const Study& study, const Series& series, const std::string& suffix,
                         Json& json) {
  add_curves(findings, study, series, suffix);
  add_thresholds(findings, study, series, json);
}

}  // namespace knap
