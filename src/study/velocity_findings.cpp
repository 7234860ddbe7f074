#include "study/velocity_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "analysis/equivalent_velocity.hpp"
#include "study/summary_table.hpp"

namespace knap {
namespace {

using Json = nlohmann::ordered_json;

// The two ways to tell how much broke; fits are made of both.
constexpr std::array responses{"breakage_ratio", "chipping_ratio"};

std::string words(const std::string& response) {
  return response == "breakage_ratio" ? "breakage ratio" : "chipping ratio";
}

std::vector<double> angles_of(const Series& series) {
  std::set<double> set;
  for (const Condition& condition : series.conditions) set.insert(condition.angle);
  return {set.begin(), set.end()};
}

/// Means with intervals of a response over something.
PlotSeries points_of(const Study& study, const std::vector<Condition>& list, const std::string& response,
                     const std::string& name, const std::function<double(const Condition&)>& x) {
  PlotSeries points{.name = name, .style = PlotSeries::Style::Points};
  for (const Condition& condition : list) {
    const Spread s = spread_of(study, condition, measure(response));
    if (!std::isfinite(s.mean)) continue;
    points.x.push_back(x(condition));
    points.y.push_back(s.mean);
    const bool has_interval = std::isfinite(s.interval.low);
    points.low.push_back(has_interval ? s.interval.low : s.mean);
    points.high.push_back(has_interval ? s.interval.high : s.mean);
  }
  return points;
}

std::vector<Condition> at_angle(const Series& series, double angle) {
  std::vector<Condition> list;
  for (const Condition& condition : series.conditions)
    if (condition.angle == angle) list.push_back(condition);
  return list;
}

// Means of a response over x, one line of points an angle.
PlotInput by_angle(const Study& study, const Series& series, const std::string& response,
                   const std::function<double(const Condition&)>& x) {
  PlotInput plot;
  for (const double angle : angles_of(series))
    plot.series.push_back(
        points_of(study, at_angle(series, angle), response, fmt::format("{:.4g}°", angle / degree), x));
  return plot;
}

void join_points(PlotInput& plot) {
  const std::size_t n = plot.series.size();
  for (std::size_t i = 0; i < n; ++i)
    plot.series.push_back({.x = plot.series[i].x, .y = plot.series[i].y, .colour = i});
}

void add_breakage_curves(Findings& findings, const Study& study, const Series& series, const std::string& suffix) {
  PageSection section{.title = titled("Breakage over speed and angle", series)};
  section.paragraphs.push_back(fmt::format(
      "Angles are from the plane of the wall: 90° is straight on. Points are means over meshes and seeds, bars their "
      "95 % bootstrap intervals. Breakage ratio: the mass that passes a sieve of {:.3g} of the particle's diameter; "
      "chipping ratio: the mass outside the largest piece.",
      study.sieve_over_diameter));
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
  PlotInput plot = over_angle("breakage_ratio");
  plot.title = titled("breakage ratio over angle", series);
  plot.x_label = "impact angle from the wall [deg]", plot.y_label = "breakage ratio [-]";
  add_figure(findings, section, "breakage_ratio_over_angle" + suffix, plot, "");
  findings.sections.push_back(std::move(section));
}

/// The speed at which the mean of a response reaches a level, straight on or as near to it as there is; between speeds
/// linearly. NaN if it does not.
double speed_at_level(const Study& study, const std::vector<Condition>& list, const std::string& response, double level,
                      const std::vector<std::vector<std::size_t>>* picks = nullptr) {
  double last_speed = 0.0, last = 0.0;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const std::vector<std::size_t>& runs = picks != nullptr ? (*picks)[k] : list[k].runs;
    double sum = 0.0;
    for (const std::size_t i : runs) sum += measure(response).value(study.runs[i]);
    const double now = sum / static_cast<double>(runs.size());
    if (now >= level)
      return k == 0 ? list[k].speed : last_speed + (level - last) / (now - last) * (list[k].speed - last_speed);
    last_speed = list[k].speed, last = now;
  }
  return std::nan("");
}

// Draws the runs of each condition anew.
std::vector<std::vector<std::vector<std::size_t>>> drawn_conditions(const std::vector<Condition>& list, int samples) {
  std::vector<std::vector<std::size_t>> groups;
  for (const Condition& condition : list) groups.push_back(condition.runs);
  std::vector<std::vector<std::vector<std::size_t>>> draws;
  for (const auto& pick : bootstrap_picks(groups, samples)) {
    auto next = pick.begin();
    draws.emplace_back();
    for (const auto& group : groups) {
      draws.back().emplace_back(next, next + static_cast<std::ptrdiff_t>(group.size()));
      next += static_cast<std::ptrdiff_t>(group.size());
    }
  }
  return draws;
}

void add_thresholds(Findings& findings, const Study& study, const Series& series, Json& json) {
  const double steepest = angles_of(series).back();
  const std::vector<Condition> list = at_angle(series, steepest);
  if (list.size() < 3) return;
  PageSection section{.title = titled("Threshold", series)};
  for (const std::string response : responses)
    for (const double level : {0.01, 0.05, 0.1, 0.5}) {
      const double speed = speed_at_level(study, list, response, level);
      std::vector<double> speeds;
      for (const auto& draw : drawn_conditions(list, bootstrap_samples))
        speeds.push_back(speed_at_level(study, list, response, level, &draw));
      const Interval interval = central_95(speeds);
      json["thresholds"].push_back({{"measure", response},
                                    {"level", level},
                                    {"angle_deg", steepest / degree},
                                    {"speed", json_of(speed)},
                                    {"interval", json_of(interval)}});
      section.rows.push_back({fmt::format("{} reaches {:g} at {:.3g}°", words(response), level, steepest / degree),
                              std::isfinite(speed) ? fmt::format("{:.3g} m/s", speed) : "not reached", shown(interval),
                              speed == list.front().speed ? "already at the slowest speed" : ""});
    }
  findings.sections.push_back(std::move(section));
}

std::vector<ObliqueImpact> impacts_of(const Study& study, const Series& series, const std::string& response) {
  std::vector<ObliqueImpact> impacts;
  for (const Condition& condition : series.conditions)
    for (const double breakage : values_of(study, condition, measure(response).value))
      impacts.push_back({condition.speed, condition.angle, condition.friction, breakage});
  return impacts;
}

Json json_of(const Collapse& collapse, const std::vector<double>& list) {
  Json json{{"curve",
             {{"plateau", collapse.curve.plateau},
              {"scale_m_per_s", collapse.curve.scale},
              {"exponent", collapse.curve.exponent}}},
            {"rms", collapse.rms},
            {"left_out_rms", collapse.left_out_rms}};
  for (std::size_t i = 0; i < list.size(); ++i)
    json["left_out_rms_by_angle"].push_back({{"angle_deg", list[i] / degree}, {"rms", collapse.left_out_by_angle[i]}});
  return json;
}

std::string sentence(CollapseVerdict verdict) {
  switch (verdict) {
    case CollapseVerdict::Beats:
      return "the equivalent velocity beats the normal component alone";
    case CollapseVerdict::Loses:
      return "the normal component alone is better than the equivalent velocity";
    case CollapseVerdict::Undecided:
      break;
  }
  return "the equivalent velocity does not beat the normal component alone: the difference is within the scatter";
}

void draw_collapse(Findings& findings, PageSection& section, const Study& study, const Series& series,
                   const std::string& response, const Collapse& collapse, double a_mu, const std::string& over,
                   const std::string& stem) {
  const auto velocity = [&](const Condition& c) { return equivalent_velocity(c.speed, c.angle, a_mu); };
  PlotInput plot = by_angle(study, series, response, velocity);
  PlotSeries curve{.name = "one curve for all", .style = PlotSeries::Style::Dashes, .colour = 4};
  double fastest = 0.0;
  for (const Condition& condition : series.conditions) fastest = std::max(fastest, velocity(condition));
  for (int i = 0; i <= 100; ++i)
    curve.x.push_back(0.01 * i * fastest), curve.y.push_back(collapse.curve(curve.x.back()));
  plot.series.push_back(curve);
  plot.title = titled(words(response) + " over " + over, series);
  plot.x_label = over + " [m/s]", plot.y_label = words(response) + " [-]";
  add_figure(findings, section, stem, plot, fmt::format("Runs lie {:.3f} (rms) from the curve.", collapse.rms));
  PlotInput residuals = by_angle(study, series, response, velocity);
  for (PlotSeries& points : residuals.series)
    for (std::size_t i = 0; i < points.x.size(); ++i) {
      const double at = collapse.curve(points.x[i]);
      points.y[i] -= at, points.low[i] -= at, points.high[i] -= at;
    }
  residuals.title = titled("residuals over " + over, series);
  residuals.x_label = over + " [m/s]", residuals.y_label = words(response) + " minus the curve [-]";
  add_figure(findings, section, stem + "_residuals", residuals, "");
}

void add_collapse(Findings& findings, const Study& study, const Series& series, const std::string& suffix, Json& json) {
  PageSection section{.title = titled("Equivalent velocity", series)};
  section.paragraphs.push_back(
      "v_eq = v sin θ √(1 + (a μ cos θ)²) (Wang et al. 2019), with a μ ≤ 1: beyond it v_eq does not rise with the "
      "angle. "
      "The null rule takes the normal component v sin θ alone. Both are judged by leaving out each angle in turn: the "
      "rms distance of its runs from the curve b(1 − exp(−(v/v₀)ⁿ)) of the other angles, mean over angles.");
  for (const std::string response : responses) {
    const std::vector<ObliqueImpact> impacts = impacts_of(study, series, response);
    std::optional<CollapseComparison> free, known;
    try {
      free = compare_collapse(impacts, FrictionRule::FreeProduct);
    } catch (const std::invalid_argument& reason) {
      json["equivalent_velocity"][response] = {{"not_fitted", reason.what()}};
      section.paragraphs.push_back(words(response) + ": not fitted, " + reason.what() + ".");
      continue;
    }
    const double friction = series.conditions.front().friction;
    const CollapseVerdict answer = verdict(*free);
    const std::vector<double> list = angles(impacts);
    Json fit = json_of(free->model, list);
    fit["a_mu"] = free->model.value;
    fit["a_mu_interval"] = json_of(free->model.interval);
    fit["a_mu_at_end_of_range"] = free->model.is_at_end;
    fit["a_with_known_friction"] = free->model.value / friction;
    fit["a_interval"] = json_of(Interval{free->model.interval.low / friction, free->model.interval.high / friction});
    fit["wall_friction"] = friction;
    json["equivalent_velocity"][response] = {{"model", fit},
                                             {"null", json_of(free->null, list)},
                                             {"gain_of_left_out_rms", json_of(free->gain)},
                                             {"scatter_of_runs", free->scatter},
                                             {"verdict", sentence(answer)}};
    const std::string of = words(response) + ": ";
    section.rows.push_back({of + "a μ", fmt::format("{:.3g}", free->model.value), shown(free->model.interval),
                            free->model.is_at_end ? "at the end of its range" : ""});
    section.rows.push_back(
        {of + fmt::format("a, for the case's μ = {:g}", friction), fmt::format("{:.3g}", free->model.value / friction),
         shown(Interval{free->model.interval.low / friction, free->model.interval.high / friction}), ""});
    section.rows.push_back({of + "left-out error of v_eq", fmt::format("{:.4f}", free->model.left_out_rms), "", ""});
    section.rows.push_back({of + "left-out error of v sin θ", fmt::format("{:.4f}", free->null.left_out_rms), "", ""});
    section.rows.push_back({of + "gain", fmt::format("{:.4f}", free->null.left_out_rms - free->model.left_out_rms),
                            shown(free->gain), sentence(answer)});
    section.rows.push_back(
        {of + "scatter of runs alike", fmt::format("{:.4f}", free->scatter), "", "what no curve can beat"});
    findings.verdicts.push_back(
        fmt::format("{}: by the {}, {} (error on an angle left out {:.3f} against {:.3f}; a μ = {}).",
                    titled("Equivalent velocity", series), words(response), sentence(answer), free->model.left_out_rms,
                    free->null.left_out_rms, shown(free->model.value, free->model.interval)));
    draw_collapse(findings, section, study, series, response, free->model, free->model.value, "equivalent velocity",
                  fmt::format("collapse_{}{}", response, suffix));
    draw_collapse(findings, section, study, series, response, free->null, 0.0, "normal velocity",
                  fmt::format("collapse_null_{}{}", response, suffix));
  }
  findings.sections.push_back(std::move(section));
}

// One a for walls of several frictions, each with its own mu.
void add_known_friction(Findings& findings, const Study& study, Json& json) {
  std::set<double> frictions;
  for (const StudyRun& run : study.runs)
    if (run.series.empty()) frictions.insert(run.friction);
  if (frictions.size() < 2) return;
  PageSection section{.title = "Equivalent velocity, one a for all frictions"};
  for (const std::string response : responses) {
    std::vector<ObliqueImpact> impacts;
    for (const Series& series : series_of(study))
      for (const ObliqueImpact& impact : impacts_of(study, series, response)) impacts.push_back(impact);
    try {
      const CollapseComparison known = compare_collapse(impacts, FrictionRule::KnownFriction);
      json[response] = json_of(known.model, angles(impacts));
      json[response]["a"] = known.model.value;
      json[response]["a_interval"] = json_of(known.model.interval);
      json[response]["verdict"] = sentence(verdict(known));
      section.rows.push_back({words(response) + ": a", fmt::format("{:.3g}", known.model.value),
                              shown(known.model.interval), sentence(verdict(known))});
    } catch (const std::invalid_argument& reason) {
      section.paragraphs.push_back(words(response) + ": not fitted, " + reason.what() + ".");
    }
  }
  findings.sections.push_back(std::move(section));
}

// The mean at a speed between those run, linearly; with which runs of each side, for the bootstrap.
std::optional<double> at_speed(const Study& study, const std::vector<Condition>& list, const std::string& response,
                               double speed, const std::vector<std::vector<std::size_t>>& runs) {
  const auto mean_at = [&](std::size_t k) {
    double sum = 0.0;
    for (const std::size_t i : runs[k]) sum += measure(response).value(study.runs[i]);
    return sum / static_cast<double>(runs[k].size());
  };
  constexpr double same = 1e-6;
  for (std::size_t k = 0; k < list.size(); ++k)
    if (std::abs(list[k].speed - speed) <= same * speed) return mean_at(k);
  for (std::size_t k = 1; k < list.size(); ++k)
    if (list[k - 1].speed < speed && speed < list[k].speed) {
      const double t = (speed - list[k - 1].speed) / (list[k].speed - list[k - 1].speed);
      return (1.0 - t) * mean_at(k - 1) + t * mean_at(k);
    }
  return std::nullopt;
}

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
    std::vector<std::vector<std::size_t>> runs;
    for (const Condition& condition : list) runs.push_back(condition.runs);
    const double speed = normal / std::sin(angle);
    const auto value = at_speed(study, list, response, speed, runs);
    if (!value) continue;
    effect.tangential.push_back(speed * std::cos(angle));
    effect.value.push_back(*value);
    std::vector<double> values;
    const auto draws = drawn_conditions(list, samples);
    for (std::size_t k = 0; k < draws.size(); ++k) {
      values.push_back(*at_speed(study, list, response, speed, draws[k]));
      drawn[k].push_back(values.back());
    }
    effect.interval.push_back(central_95(values));
  }
  if (effect.value.size() < 3) return effect;
  effect.slope = slope_of(effect.tangential, effect.value);
  std::vector<double> slopes;
  for (const auto& values : drawn) slopes.push_back(slope_of(effect.tangential, values));
  effect.slope_interval = central_95(slopes);
  return effect;
}

void add_tangential(Findings& findings, const Study& study, const Series& series,
                    const std::vector<double>& normal_speeds, const std::string& suffix, Json& json) {
  PageSection section{.title = titled("Effect of the tangential velocity", series)};
  section.paragraphs.push_back(
      "At one normal velocity, under all angles: between the speeds that were run, linearly. The slope is that of a "
      "straight line, its interval 95 % by bootstrap.");
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
        points.low.push_back(interval.low), points.high.push_back(interval.high);
      plot.series.push_back(points);
      const std::string answer = effect.slope_interval.low > 0.0    ? "rises with the tangential velocity"
                                 : effect.slope_interval.high < 0.0 ? "falls with the tangential velocity"
                                                                    : "no effect beyond the scatter";
      const double range = *std::max_element(effect.value.begin(), effect.value.end()) -
                           *std::min_element(effect.value.begin(), effect.value.end());
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
  std::map<std::pair<std::string, long>, std::vector<const StudyRun*>> alike;
  for (const Condition& condition : series.conditions)
    for (const std::size_t i : condition.runs) {
      const StudyRun& run = study.runs[i];
      const double normal = run.speed * std::sin(run.angle);
      alike[{run.mesh + run.seed, std::lround(1e4 * normal)}].push_back(&run);
    }
  PageSection section{.title = titled("A wall without friction", series)};
  section.paragraphs.push_back(
      "Without friction damage depends on v sin θ only (the tangential part is a rigid translation): an exact check. "
      "Differences are round-off that cracks amplify once they branch.");
  double largest = 0.0, squares = 0.0, closest = 0.0;
  std::size_t pairs = 0;
  for (const auto& [key, runs] : alike)
    for (std::size_t k = 1; k < runs.size(); ++k) {
      const double difference = std::abs(runs[k]->chipping_ratio() - runs[0]->chipping_ratio());
      largest = std::max(largest, difference);
      squares += difference * difference, ++pairs;
      closest += difference < 1e-9 ? 1.0 : 0.0;
    }
  if (pairs == 0) return;
  const double rms = std::sqrt(squares / static_cast<double>(pairs));
  json["frictionless_identity"] = {{"pairs", pairs},
                                   {"largest_difference", largest},
                                   {"rms_difference", rms},
                                   {"equal_to_1e-9", closest / static_cast<double>(pairs)}};
  section.rows.push_back({"pairs of runs with the same normal velocity", std::to_string(pairs), "", ""});
  section.rows.push_back({"largest difference of the chipping ratio", fmt::format("{:.2g}", largest), "", ""});
  section.rows.push_back({"rms difference", fmt::format("{:.2g}", rms), "", ""});
  section.rows.push_back(
      {"equal to 1e-9", fmt::format("{:.0f} %", 100.0 * closest / static_cast<double>(pairs)), "", ""});
  findings.verdicts.push_back(
      fmt::format("{}: at equal normal velocity, chipping ratios differ by {:.2g} at most, {:.2g} "
                  "rms, over {} pairs.",
                  titled("No friction", series), largest, rms, pairs));
  findings.sections.push_back(std::move(section));
}

bool varies_speed(const Series& series) {
  std::set<double> speeds;
  for (const Condition& condition : series.conditions)
    if (condition.speed > 0.0) speeds.insert(condition.speed);
  return speeds.size() > 1;
}

}  // namespace

void add_velocity_findings(Findings& findings, const Study& study, const std::vector<double>& normal_speeds) {
  const std::vector<Series> all = series_of(study);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Series& series = all[k];
    if (!varies_speed(series)) continue;
    const std::string suffix = suffix_of(k, all.size());
    Json json{{"series", series.name}};
    add_breakage_curves(findings, study, series, suffix);
    add_thresholds(findings, study, series, json);
    if (angles_of(series).size() > 1) {
      if (series.conditions.front().friction > 0.0) {
        add_collapse(findings, study, series, suffix, json);
        add_tangential(findings, study, series, normal_speeds, suffix, json);
      } else {
        add_frictionless(findings, study, series, json);
      }
    }
    findings.json["velocity"].push_back(json);
  }
  add_known_friction(findings, study, findings.json["one_a_for_all_frictions"]);
}

}  // namespace knap
