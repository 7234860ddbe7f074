#include "study/chipping_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/chipping_law.hpp"
#include "study/condition_plots.hpp"
#include "study/summary_table.hpp"

namespace knap {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array classes{"intact", "chipped", "split", "fragmented"};

// What most of the runs are; of two equally many the milder.
std::string class_of(const Study& study, const Condition& condition) {
  std::map<std::string, int> counts;
  for (const std::size_t i : condition.runs) ++counts[study.runs[i].breakage_class];
  std::string most;
  for (const char* one : classes)
    if (counts[one] > counts[most]) most = one;
  return most;
}

void add_class_map(Findings& findings, const Study& study, const Series& series, const std::string& suffix,
                   Json& json) {
  PlotInput plot{.title = titled("classes", series),
                 .x_label = "impact speed [m/s]",
                 .y_label = "impact angle from the wall [deg]"};
  for (const char* one : classes) {
    PlotSeries points{.name = one, .style = PlotSeries::Style::Points};
    for (const Condition& condition : series.conditions)
      if (class_of(study, condition) == one)
        points.x.push_back(condition.speed), points.y.push_back(condition.angle / degree);
    plot.series.push_back(points);
  }
  for (const Condition& condition : series.conditions) {
    std::map<std::string, int> counts;
    for (const std::size_t i : condition.runs) ++counts[study.runs[i].breakage_class];
    Json one{
        {"angle_deg", condition.angle / degree}, {"speed", condition.speed}, {"class", class_of(study, condition)}};
    for (const char* name : classes) one[name] = counts[name];
    json["class_map"].push_back(one);
  }
  PageSection section{.title = titled("Class map", series)};
  section.paragraphs.push_back(
      "What most runs of a speed and angle are. Intact: less than 0.1 % lost; chipped: one piece holds at least 75 %; "
      "split: two to four big pieces together hold at least 75 %; fragmented: anything more.");
  add_figure(findings, section, "class_map" + suffix, plot, "");
  findings.sections.push_back(std::move(section));
}

/// Runs that one law is fitted to.
struct Part {
  std::string name;   // of what the law is over
  std::string range;  // which runs
  std::vector<Chipping> runs{};
};

// "Chipping above the threshold" can be read in several ways, and the exponent depends on it: all runs at speeds that
// mostly chip, or that lose between a hundredth and a quarter on average; or the chipped runs alone, without those of
// the same speed that split, where they lose a hundredth.
std::vector<Part> parts_of(const Study& study, const Series& series) {
  constexpr double threshold = 0.01, largest_chipping = 0.25;
  const double steepest = angles_of(series).back();
  const std::string straight_name = fmt::format("speed at {:.3g}°", steepest / degree);
  Part chipped{straight_name, "most runs chipped"}, above{straight_name, "mean loss 1 to 25 %"};
  const std::string alone = "chipped runs alone, from 1 %";
  Part chips{straight_name, alone}, normal{"normal velocity, all angles", alone};
  for (const Condition& condition : series.conditions) {
    const bool is_chipped = class_of(study, condition) == "chipped";
    const double loss = mean_of(study, condition.runs, "chipping_ratio");
    const bool is_above = loss >= threshold && loss <= largest_chipping;
    std::vector<double> chip_losses;
    for (const std::size_t i : condition.runs) {
      const StudyRun& run = study.runs[i];
      const double ratio = run.chipping_ratio();
      if (!std::isfinite(ratio)) continue;
      if (condition.angle == steepest && is_chipped) chipped.runs.push_back({condition.speed, ratio});
      if (condition.angle == steepest && is_above) above.runs.push_back({condition.speed, ratio});
      if (run.breakage_class == "chipped") chip_losses.push_back(ratio);
    }
    if (chip_losses.empty() || mean(chip_losses) < threshold) continue;
    for (const double ratio : chip_losses) {
      if (condition.angle == steepest) chips.runs.push_back({condition.speed, ratio});
      normal.runs.push_back({normal_speed(condition.speed, condition.angle), ratio});
    }
  }
  std::vector<Part> parts{chipped, above, chips};
  if (angles_of(series).size() > 1) parts.push_back(normal);
  return parts;
}

void draw_law(Findings& findings, PageSection& section, const Part& part, const ChippingLaw& law, const Series& series,
              const std::string& stem) {
  std::map<double, std::vector<double>> by_speed;
  for (const Chipping& run : part.runs) by_speed[run.speed].push_back(run.ratio);
  PlotSeries points{.name = "runs", .style = PlotSeries::Style::Points, .colour = 6};
  PlotSeries means{.name = "means", .style = PlotSeries::Style::Points, .colour = 0};
  for (const auto& [speed, ratios] : by_speed) {
    for (const double ratio : ratios)
      if (ratio > 0.0) points.x.push_back(speed), points.y.push_back(ratio);
    if (mean(ratios) > 0.0) means.x.push_back(speed), means.y.push_back(mean(ratios));
  }
  const auto line = [&](double exponent, const std::string& name, PlotSeries::Style style, std::size_t colour) {
    const double middle = std::sqrt(law.slowest * law.fastest);
    const double at_middle = law.factor * std::pow(middle, law.exponent);
    PlotSeries curve{.name = name, .style = style, .colour = colour};
    for (const double v : {law.slowest, law.fastest})
      curve.x.push_back(v), curve.y.push_back(at_middle * std::pow(v / middle, exponent));
    return curve;
  };
  PlotInput plot{.title = titled(fmt::format("chipping over {}, {}", part.name, part.range), series),
                 .x_label = part.name + " [m/s]",
                 .y_label = "chipping ratio [-]",
                 .log_x = true,
                 .log_y = true};
  plot.series = {points, means,
                 line(law.exponent, fmt::format("fit, {:.2f}", law.exponent), PlotSeries::Style::Line, 0),
                 line(2.0, "published, 2", PlotSeries::Style::Dashes, 4),
                 line(4.5, "published, 4.5", PlotSeries::Style::Dashes, 5)};
  add_figure(findings, section, stem, plot, "The published laws are drawn through the middle of the fit.");
  PlotInput residuals{.title = plot.title + ": residuals",
                      .x_label = plot.x_label,
                      .y_label = "runs over the law [-]",
                      .log_x = true,
                      .log_y = true};
  for (PlotSeries over_law : {points, means}) {
    for (std::size_t i = 0; i < over_law.x.size(); ++i)
      over_law.y[i] /= law.factor * std::pow(over_law.x[i], law.exponent);
    residuals.series.push_back(over_law);
  }
  add_figure(findings, section, stem + "_residuals", residuals, "");
}

void add_laws(Findings& findings, const Study& study, const Series& series, const std::string& suffix, Json& json) {
  PageSection section{.title = titled("Chipping law", series)};
  section.paragraphs.push_back(
      "Chipping ratio = C vⁿ, by the logarithms of the means at each speed: of the speeds at which most runs are "
      "chipped (one piece holds 75 %), and of those that lose 1 to 25 % on average; and of the chipped runs alone, "
      "without those that split at the same speed, where these lose 1 % or more on average: published laws are of "
      "chips. "
      "The interval is 95 %, by bootstrap over runs.");
  int number = 0;
  for (const Part& part : parts_of(study, series)) {
    ++number;
    Json& one = json["chipping_law"].emplace_back(Json{{"over", part.name}, {"range", part.range}});
    try {
      const ChippingLaw law = fit_chipping_law(part.runs);
      one["exponent"] = law.exponent, one["interval"] = json_of(law.interval), one["factor"] = law.factor;
      one["speeds"] = law.num_speeds, one["slowest"] = law.slowest, one["fastest"] = law.fastest;
      std::string agreeing;
      for (const PublishedExponent& published : published_exponents) {
        const bool is_inside = law.interval.contains(published.exponent);
        one["published"].push_back(
            {{"exponent", published.exponent}, {"source", published.source}, {"within_interval", is_inside}});
        if (is_inside)
          agreeing += fmt::format("{}{:g} ({})", agreeing.empty() ? "" : ", ", published.exponent, published.source);
      }
      section.rows.push_back(
          {fmt::format("exponent over {}, {}", part.name, part.range), fmt::format("{:.3g}", law.exponent),
           shown(law.interval),
           fmt::format("{} speeds, {:.3g} to {:.3g} m/s; within it of the published: {}", law.num_speeds, law.slowest,
                       law.fastest, agreeing.empty() ? "none" : agreeing)});
      findings.verdicts.push_back(
          fmt::format("{}: exponent of the {} ({}) {}; of the published 2, 2.33, 2.44, 3.17, 4.5 within it: {}.",
                      titled("Chipping law", series), part.name, part.range, shown(law.exponent, law.interval),
                      agreeing.empty() ? "none" : agreeing));
      draw_law(findings, section, part, law, series, fmt::format("chipping_law_{}{}", number, suffix));
    } catch (const std::invalid_argument& reason) {
      one["not_fitted"] = reason.what();
      section.rows.push_back(
          {fmt::format("exponent over {}, {}", part.name, part.range), "not fitted", "", reason.what()});
    }
  }
  findings.sections.push_back(std::move(section));
}

}  // namespace

void add_chipping_findings(Findings& findings, const Study& study) {
  const std::vector<Series> all = series_of(study);
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (all[k].conditions.front().speed <= 0.0) continue;
    Json json{{"series", all[k].name}};
    const std::string suffix = suffix_of(k, all.size());
    add_class_map(findings, study, all[k], suffix, json);
    add_laws(findings, study, all[k], suffix, json);
    findings.json["chipping"].push_back(json);
  }
}

}  // namespace knap
