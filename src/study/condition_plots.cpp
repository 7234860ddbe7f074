#include "study/condition_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "study/summary_table.hpp"

namespace knap {

std::string words(std::string measure) {
  std::replace(measure.begin(), measure.end(), '_', ' ');
  return measure;
}

double normal_speed(double speed, double angle) {
  constexpr double per_unit = 1e4;
  return std::round(per_unit * speed * std::sin(angle)) / per_unit;
}

std::vector<double> angles_of(const Series& series) {
  std::set<double> set;
  for (const Condition& condition : series.conditions) set.insert(condition.angle);
  return {set.begin(), set.end()};
}

std::vector<Condition> at_angle(const Series& series, double angle) {
  std::vector<Condition> list;
  for (const Condition& condition : series.conditions)
    if (condition.angle == angle) list.push_back(condition);
  return list;
}

std::vector<Condition> at_steepest_angle(const Series& series) { return at_angle(series, angles_of(series).back()); }

PlotSeries points_of(const Study& study, const std::vector<Condition>& list, const std::string& measure_name,
                     const std::string& name, const std::function<double(const Condition&)>& x) {
  PlotSeries points{.name = name, .style = PlotSeries::Style::Points};
  for (const Condition& condition : list) {
    const Spread s = spread_of(study, condition, measure(measure_name));
    if (!std::isfinite(s.mean)) continue;
    points.x.push_back(x(condition));
    points.y.push_back(s.mean);
    const bool has_interval = std::isfinite(s.interval.low);
    points.low.push_back(has_interval ? s.interval.low : s.mean);
    points.high.push_back(has_interval ? s.interval.high : s.mean);
  }
  return points;
}

PlotInput by_angle(const Study& study, const Series& series, const std::string& measure_name,
                   const std::function<double(const Condition&)>& x) {
  PlotInput plot;
  for (const double angle : angles_of(series))
    plot.series.push_back(
        points_of(study, at_angle(series, angle), measure_name, fmt::format("{:.4g}°", angle / degree), x));
  return plot;
}

void join_points(PlotInput& plot) {
  const std::size_t n = plot.series.size();
  for (std::size_t i = 0; i < n; ++i)
    plot.series.push_back({.x = plot.series[i].x, .y = plot.series[i].y, .colour = i});
}

double mean_of(const Study& study, const std::vector<std::size_t>& runs, const std::string& measure_name) {
  const auto& value = measure(measure_name).value;
  double sum = 0.0;
  for (const std::size_t i : runs) sum += value(study.runs[i]);
  return sum / static_cast<double>(runs.size());
}

bool has_repeats(const std::vector<Condition>& list) {
  std::size_t runs = 0;
  for (const Condition& condition : list) runs += condition.runs.size();
  return runs >= 2 * list.size();
}

std::vector<std::vector<std::size_t>> runs_of(const std::vector<Condition>& list) {
  std::vector<std::vector<std::size_t>> runs;
  for (const Condition& condition : list) runs.push_back(condition.runs);
  return runs;
}

std::vector<std::vector<std::vector<std::size_t>>> drawn_conditions(const std::vector<Condition>& list, int samples) {
  const std::vector<std::vector<std::size_t>> groups = runs_of(list);
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

}  // namespace knap
