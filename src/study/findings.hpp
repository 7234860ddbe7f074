#pragma once
// What a study has found, gathered section by section: numbers for analysis.json, tables, plots, sentences for the
// page.
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "analysis/fit.hpp"
#include "analysis/statistics.hpp"
#include "io/plot.hpp"
#include "report/campaign_page.hpp"
#include "study/study_runs.hpp"

namespace knap {

struct Findings {
  std::filesystem::path folder;  ///< of tables and plots
  bool has_plots = true;         ///< off where there are too many series to look at
  nlohmann::ordered_json json{};
  std::vector<PageSection> sections{};
  std::vector<std::string> verdicts{};  ///< plain sentences
};

/// Draws stem.png and stem.svg and shows the plot in a section. A plot without a point is left out.
void add_figure(Findings& findings, PageSection& section, const std::string& stem, const PlotInput& plot,
                const std::string& caption);

/// Points minus a law at the same x, error bars with them.
PlotSeries residuals_of(const PlotSeries& points, const std::function<double(double)>& law, const std::string& name,
                        std::size_t colour);

/// A law over what a plot's x axis shows, from some value on.
struct DrawnLaw {
  std::string name;
  std::function<double(double)> law;
  double from = 0.0;
};
/// Draws points with laws, and as stem_residuals the points minus each law. `plot` brings title, labels and marks.
void add_fit_figures(Findings& findings, PageSection& section, const std::string& stem, PlotInput plot,
                     const PlotSeries& points, const std::vector<DrawnLaw>& laws, const std::string& caption);

/// A text that names a file for a series: "" for the only one, else "-2".
std::string suffix_of(std::size_t series, std::size_t num_series);
/// "title" or "title (series)".
std::string titled(const std::string& title, const Series& series);

/// "12 [10, 15]"; in JSON null for what is not finite.
std::string shown(double value, const Interval& interval);
std::string shown(const Interval& interval);
std::string shown(double value);
nlohmann::ordered_json json_of(double value);
nlohmann::ordered_json json_of(const Interval& interval);
/// Values, standard errors, covariance, whether at an end of the range, units.
nlohmann::ordered_json json_of(const Fit& fit);
/// A row for each parameter; the second without standard errors, for data that depend on each other.
void add_rows(PageSection& section, const std::string& law, const Fit& fit);
void add_values(PageSection& section, const std::string& law, Fit fit);

/// A table of numbers as CSV, in one step; NaN as an empty cell.
void write_table(const std::filesystem::path& file, const std::vector<std::string>& columns,
                 const std::vector<std::vector<double>>& rows);

/// The values of runs.
template <class Value>
std::vector<double> values_of(const Study& study, const Condition& condition, const Value& value) {
  std::vector<double> values;
  for (const std::size_t i : condition.runs) values.push_back(value(study.runs[i]));
  return values;
}

inline constexpr double degree = 0.017453292519943295;  ///< [rad]

}  // namespace knap
