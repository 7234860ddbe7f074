#include "study/summary_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "io/csv_line.hpp"
#include "io/file_output.hpp"

namespace knap {
namespace {

constexpr Interval share{0.0, 1.0}, not_negative{0.0, any_value.high};

Measure of_column(const std::string& name, const std::string& unit, const std::string& column, Interval range) {
  return {name, unit, [column](const StudyRun& run) { return run.number(column); }, range};
}

std::vector<Measure> all_measures() {
  std::vector<Measure> list{of_column("chipping_ratio", "-", "breakage.chipping_ratio", share),
                            {"breakage_ratio", "-", [](const StudyRun& run) { return run.breakage_ratio; }, share}};
  for (const int n : fineness_divisors)
    list.push_back(of_column(fmt::format("t{}", n), "-", fmt::format("breakage.t{}", n), share));
  const std::string pieces = "fragments.by_damage_label.";
  for (const char* name : {"largest_mass_fraction", "second_mass_fraction", "unresolved_mass_fraction"})
    list.push_back(of_column(name, "-", pieces + name, share));
  for (const char* name : {"count", "count_above_1pct", "count_above_0p1pct"})
    list.push_back(of_column(name, "-", pieces + name, not_negative));
  list.push_back({"sphericity", "-", [](const StudyRun& run) { return run.shape.sphericity; }, share});
  list.push_back({"elongation", "-", [](const StudyRun& run) { return run.shape.elongation; }, share});
  list.push_back({"flatness", "-", [](const StudyRun& run) { return run.shape.flatness; }, share});
  list.push_back({"convexity", "-", [](const StudyRun& run) { return run.shape.convexity; }, share});
  list.push_back(of_column("restitution_normal", "-", "rebound.restitution_normal", any_value));
  list.push_back(of_column("restitution_tangential", "-", "rebound.restitution_tangential", any_value));
  list.push_back(of_column("cracked_area", "m2", "cracks.area", not_negative));
  for (const char* term : {"kinetic", "strain", "cohesive_stored", "cohesive_dissipated", "closure_impact",
                           "crack_friction", "contact_dissipated", "tool_friction", "tool_impact", "viscous"})
    list.push_back(of_column(fmt::format("energy_{}", term), "-", fmt::format("energy.{}", term), any_value));
  list.push_back(of_column("energy_closure_error", "-", "energy.closure_error", not_negative));
  return list;
}

}  // namespace

const std::vector<Measure>& measures() {
  static const std::vector<Measure> list = all_measures();
  return list;
}

const Measure& measure(const std::string& name) {
  const auto found =
      std::find_if(measures().begin(), measures().end(), [&](const Measure& m) { return m.name == name; });
  if (found == measures().end()) throw std::out_of_range("no measure " + name);
  return *found;
}

Spread spread_of(const Study& study, const Condition& condition, const Measure& measure) {
  std::vector<double> values;
  std::map<std::string, std::vector<double>> by_mesh;
  for (const std::size_t i : condition.runs) {
    const double value = measure.value(study.runs[i]);
    if (!std::isfinite(value)) continue;
    values.push_back(value);
    by_mesh[study.runs[i].mesh].push_back(value);
  }
  std::vector<double> means;
  double squares = 0.0, freedom = 0.0;
  for (const auto& [mesh, of_mesh] : by_mesh) {
    means.push_back(mean(of_mesh));
    for (const double value : of_mesh) squares += (value - means.back()) * (value - means.back());
    freedom += static_cast<double>(of_mesh.size() - 1);
  }
  const Interval interval = mean_interval(values);
  return {.count = values.size(),
          .mean = mean(values),
          .deviation = standard_deviation(values),
          .between_meshes = standard_deviation(means),
          .between_seeds = std::sqrt(squares / freedom),
          .interval = {std::max(interval.low, measure.range.low), std::min(interval.high, measure.range.high)}};
}

void add_summary(Findings& findings, const Study& study) {
  std::string text =
      "series,wall_friction [-],angle [deg],speed [m/s],measure,unit,runs,mean,deviation,between_meshes,between_seeds,"
      "low_95,high_95\n";
  const auto cell = [](double value) { return std::isfinite(value) ? fmt::format("{}", value) : std::string(); };
  for (const Condition& condition : conditions(study))
    for (const Measure& one : measures()) {
      const Spread s = spread_of(study, condition, one);
      text += fmt::format("{},{},{:.6g},{},{},{},{},{},{},{},{},{},{}\n", csv_quoted(condition.series),
                          condition.friction, condition.angle / degree, condition.speed, one.name, one.unit, s.count,
                          cell(s.mean), cell(s.deviation), cell(s.between_meshes), cell(s.between_seeds),
                          cell(s.interval.low), cell(s.interval.high));
    }
  write_text_atomically(findings.folder / "summary.csv", text);
}

}  // namespace knap
