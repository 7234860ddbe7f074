#include "study/findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/file_output.hpp"

namespace knap {
namespace {

using Json = nlohmann::ordered_json;

std::string remark_of(const Fit& fit, std::size_t i) {
  if (fit.is_at_end[i]) return "at the end of its range: the data leave it open";
  if (fit.covariance.size() == 0) return "the data leave it open";
  return fit.is_kinked[i] ? "at a kink of the likelihood: no standard error" : "";
}

}  // namespace

void add_figure(Findings& findings, PageSection& section, const std::string& stem, const PlotInput& plot,
                const std::string& caption) {
  bool has_points = false;
  for (const PlotSeries& series : plot.series) has_points = has_points || !series.x.empty();
  if (!has_points || !findings.has_plots) return;
  draw_plot_twice(findings.folder / stem, plot);
  section.figures.push_back({plot.title, findings.folder / (stem + ".svg"), caption});
}

PlotSeries residuals_of(const PlotSeries& points, const std::function<double(double)>& law, const std::string& name,
                        std::size_t colour) {
  PlotSeries residuals = points;
  residuals.name = name, residuals.colour = colour;
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    const double at = law(points.x[i]);
    residuals.y[i] -= at;
    if (!points.low.empty()) residuals.low[i] -= at, residuals.high[i] -= at;
  }
  return residuals;
}

void add_fit_figures(Findings& findings, PageSection& section, const std::string& stem, PlotInput plot,
                     const PlotSeries& points, const std::vector<DrawnLaw>& laws, const std::string& caption) {
  if (points.x.empty()) return;
  PlotInput residuals{.title = plot.title + ": residuals", .x_label = plot.x_label, .y_label = "runs minus the law"};
  const double highest = *std::max_element(points.x.begin(), points.x.end());
  plot.series = {points};
  for (std::size_t k = 0; k < laws.size(); ++k) {
    const auto& [name, law, from] = laws[k];
    PlotSeries curve{.name = name, .colour = k + 1}, within{.style = points.style};
    constexpr int pieces = 200;
    for (int i = 0; i <= pieces; ++i) {
      curve.x.push_back(from + (highest - from) * i / pieces);
      curve.y.push_back(law(curve.x.back()));
    }
    for (std::size_t i = 0; i < points.x.size(); ++i) {
      if (points.x[i] < from) continue;
      within.x.push_back(points.x[i]), within.y.push_back(points.y[i]);
      if (!points.low.empty()) within.low.push_back(points.low[i]), within.high.push_back(points.high[i]);
    }
    plot.series.push_back(curve);
    residuals.series.push_back(residuals_of(within, law, name, k + 1));
  }
  add_figure(findings, section, stem, plot, caption);
  add_figure(findings, section, stem + "_residuals", residuals, "");
}

std::string suffix_of(std::size_t series, std::size_t num_series) {
  return num_series < 2 ? "" : fmt::format("-{}", series + 1);
}

std::string titled(const std::string& title, const Series& series) {
  return series.name.empty() ? title : fmt::format("{} ({})", title, series.name);
}

std::string shown(double value) {
  constexpr double round_off = 1e-6;  // of fitted values that are as good as zero
  if (std::isinf(value)) return "above what was run";
  if (std::isnan(value)) return "not resolved";
  return std::abs(value) < round_off ? "0" : fmt::format("{:.3g}", value);
}
std::string shown(const Interval& interval) {
  return !std::isnan(interval.low) ? fmt::format("[{}, {}]", shown(interval.low), shown(interval.high)) : "";
}
std::string shown(double value, const Interval& interval) {
  const std::string ends = shown(interval);
  return ends.empty() ? shown(value) : shown(value) + " " + ends;
}

Json json_of(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
Json json_of(const Interval& interval) { return {json_of(interval.low), json_of(interval.high)}; }

Json json_of(const Fit& fit) {
  Json json;
  for (std::size_t i = 0; i < fit.parameters.size(); ++i)
    json[fit.parameters[i].name] = {{"value", fit.values[i]},
                                    {"standard_error", json_of(fit.errors[i])},
                                    {"unit", fit.parameters[i].unit},
                                    {"at_end_of_range", static_cast<bool>(fit.is_at_end[i])},
                                    {"at_kink", static_cast<bool>(fit.is_kinked[i])}};
  Json covariance = nullptr;
  if (fit.covariance.size() > 0) {
    covariance = Json::array();
    for (Eigen::Index i = 0; i < fit.covariance.rows(); ++i) {
      covariance.push_back(Json::array());
      for (Eigen::Index j = 0; j < fit.covariance.cols(); ++j)
        covariance.back().push_back(json_of(fit.covariance(i, j)));
    }
  }
  return {{"parameters", json}, {"covariance", covariance}, {"data", fit.num_data}};
}

void add_rows(PageSection& section, const std::string& law, const Fit& fit) {
  for (std::size_t i = 0; i < fit.parameters.size(); ++i) {
    const FitParameter& p = fit.parameters[i];
    const std::string unit = p.unit == "-" ? "" : " " + p.unit;
    section.rows.push_back({law + ": " + p.name, fmt::format("{:.4g}{}", fit.values[i], unit),
                            std::isfinite(fit.errors[i]) ? fmt::format("± {:.2g}", fit.errors[i]) : "",
                            remark_of(fit, i)});
  }
}

void add_values(PageSection& section, const std::string& law, Fit fit) {
  std::fill(fit.errors.begin(), fit.errors.end(), std::nan(""));
  add_rows(section, law, fit);
}

void write_table(const std::filesystem::path& file, const std::vector<std::string>& columns,
                 const std::vector<std::vector<double>>& rows) {
  std::string text = fmt::format("{}\n", fmt::join(columns, ","));
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i)
      text += (i == 0 ? "" : ",") + (std::isfinite(row[i]) ? fmt::format("{}", row[i]) : std::string());
    text += "\n";
  }
  write_text_atomically(file, text);
}

}  // namespace knap
