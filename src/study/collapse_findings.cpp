#include "study/collapse_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "analysis/equivalent_velocity.hpp"
#include "study/condition_plots.hpp"
#include "study/summary_table.hpp"

namespace knap {
namespace {

using Json = nlohmann::ordered_json;

std::vector<ObliqueImpact> impacts_of(const Study& study, const Series& series, const std::string& response) {
  std::vector<ObliqueImpact> impacts;
  for (const Condition& condition : series.conditions)
    for (const double breakage : values_of(study, condition, measure(response).value))
      if (std::isfinite(breakage)) impacts.push_back({condition.speed, condition.angle, condition.friction, breakage});
  return impacts;
}

Json collapse_json(const Collapse& collapse, const std::vector<double>& list) {
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
  for (std::size_t i = 0; i < residuals.series.size(); ++i)
    residuals.series[i] = residuals_of(residuals.series[i], collapse.curve, residuals.series[i].name, i);
  residuals.title = titled("residuals over " + over, series);
  residuals.x_label = over + " [m/s]", residuals.y_label = words(response) + " minus the curve [-]";
  add_figure(findings, section, stem + "_residuals", residuals, "");
}

std::string answer_of(const CollapseComparison& found) {
  if (!found.has_repeats) return "no verdict without repeats: run several seeds";
  if (is_null_rule(found)) return "the best equivalent velocity is the normal component itself";
  return sentence(verdict(found));
}

// One fit, as rows, numbers and a sentence.
void tell(Findings& findings, PageSection& section, const Series& series, const std::string& name,
          const CollapseComparison& found, Json& json) {
  const double friction = series.conditions.front().friction;
  const Interval a{found.model.interval.low / friction, found.model.interval.high / friction};
  std::vector<double> list = angles_of(series);
  Json model = collapse_json(found.model, list);
  model["a_mu"] = found.model.value;
  model["a_mu_interval"] = json_of(found.model.interval);
  model["a_mu_at_end_of_range"] = found.model.is_at_end;
  model["a_with_known_friction"] = found.model.value / friction;
  model["a_interval"] = json_of(a);
  model["wall_friction"] = friction;
  const std::string answer = answer_of(found);
  json = {{"model", model},
          {"null", collapse_json(found.null, list)},
          {"gain_of_left_out_rms", json_of(found.gain)},
          {"scatter_of_runs", found.scatter},
          {"verdict", answer}};
  const auto add = [&](const std::string& what, const std::string& value, const std::string& interval,
                       const std::string& remark) {
    section.rows.push_back({name + ": " + what, value, interval, remark});
  };
  add("a μ", shown(found.model.value), shown(found.model.interval),
      found.model.is_at_end ? "at the end of its range" : "");
  add(fmt::format("a, for the case's μ = {:g}", friction), shown(found.model.value / friction), shown(a), "");
  add("left-out error of v_eq", fmt::format("{:.4f}", found.model.left_out_rms), "", "");
  add("left-out error of v sin θ", fmt::format("{:.4f}", found.null.left_out_rms), "", "");
  add("gain", fmt::format("{:.4f}", found.null.left_out_rms - found.model.left_out_rms), shown(found.gain), answer);
  add("scatter of runs alike", fmt::format("{:.4f}", found.scatter), "",
      "about the means of their own speed and angle");
  findings.verdicts.push_back(
      fmt::format("{}: by the {}, {} (error on an angle left out {:.3f} against {:.3f}; a μ = {}).",
                  titled("Equivalent velocity", series), name, answer, found.model.left_out_rms,
                  found.null.left_out_rms, shown(found.model.value, found.model.interval)));
}

}  // namespace

void add_collapse(Findings& findings, const Study& study, const Series& series, const std::string& suffix, int samples,
                  Json& json) {
  PageSection section{.title = titled("Equivalent velocity", series)};
  section.paragraphs.push_back(
      "v_eq = v sin θ √(1 + (a μ cos θ)²) (Wang et al. 2019), with a μ ≤ 1: beyond it v_eq does not rise with the "
      "angle. The null rule takes the normal component v sin θ alone. Both are judged by leaving out each angle in "
      "turn: the rms distance of its runs from the curve b(1 − exp(−(v/v₀)ⁿ)) of the other angles, mean over angles. "
      "On the plain scale the large scatter far above the threshold decides; on the stabilised one, asin √b, all "
      "speeds count alike.");
  for (const std::string response : responses) {
    const std::vector<ObliqueImpact> impacts = impacts_of(study, series, response);
    for (const BreakageScale scale : {BreakageScale::Plain, BreakageScale::Stabilised}) {
      const bool is_plain = scale == BreakageScale::Plain;
      const std::string key = is_plain ? response : response + "_stabilised";
      const std::string name = is_plain ? words(response) : words(response) + ", stabilised";
      try {
        const CollapseComparison found = compare_collapse(impacts, FrictionRule::FreeProduct, scale, samples);
        tell(findings, section, series, name, found, json["equivalent_velocity"][key]);
        if (!is_plain) continue;
        draw_collapse(findings, section, study, series, response, found.model, found.model.value, "equivalent velocity",
                      fmt::format("collapse_{}{}", response, suffix));
        draw_collapse(findings, section, study, series, response, found.null, 0.0, "normal velocity",
                      fmt::format("collapse_null_{}{}", response, suffix));
      } catch (const std::invalid_argument& reason) {
        json["equivalent_velocity"][key] = {{"not_fitted", reason.what()}};
        section.paragraphs.push_back(name + ": not fitted, " + reason.what() + ".");
      }
    }
  }
  findings.sections.push_back(std::move(section));
}

void add_known_friction(Findings& findings, const Study& study, int samples) {
  std::map<std::string, std::set<double>> frictions;
  for (const StudyRun& run : study.runs)
    if (run.has_wall) frictions[run.series].insert(run.friction);
  for (const auto& [name, different] : frictions) {
    if (different.size() < 2) continue;
    Json json{{"series", name}};
    PageSection section{.title = titled("Equivalent velocity, one a for all frictions", Series{.name = name})};
    for (const std::string response : responses) {
      std::vector<ObliqueImpact> impacts;
      for (const Series& series : series_of(study))
        if (series.conditions.front().series == name)
          for (const ObliqueImpact& impact : impacts_of(study, series, response)) impacts.push_back(impact);
      try {
        const CollapseComparison known =
            compare_collapse(impacts, FrictionRule::KnownFriction, BreakageScale::Plain, samples);
        const std::string answer = answer_of(known);
        json[response] = collapse_json(known.model, angles(impacts));
        json[response]["a"] = known.model.value;
        json[response]["a_interval"] = json_of(known.model.interval);
        json[response]["verdict"] = answer;
        section.rows.push_back(
            {words(response) + ": a", shown(known.model.value), shown(known.model.interval), answer});
      } catch (const std::invalid_argument& reason) {
        section.paragraphs.push_back(words(response) + ": not fitted, " + reason.what() + ".");
      }
    }
    findings.json["one_a_for_all_frictions"].push_back(json);
    findings.sections.push_back(std::move(section));
  }
}

}  // namespace knap
