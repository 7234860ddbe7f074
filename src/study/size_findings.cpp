#include "study/size_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/size_fits.hpp"
#include "study/condition_plots.hpp"
#include "study/summary_table.hpp"

namespace knap {
namespace {

using Json = nlohmann::ordered_json;

// Sieves are told over the particle's diameter.
constexpr double largest_sieve = 1.1892071150027210;  // 2^(1/4): the whole particle passes it
constexpr double smallest_sieve = 0.02;

// What a condition must lose on average, and how far the power law of the fines is looked for, over the diameter.
constexpr double least_loss = 0.01, largest_fines = 0.25;

void add_law(PageSection& section, const Condition& condition, const std::string& name, const Fit& fit,
             const std::string& exponent, const std::string& size) {
  section.rows.push_back(
      {fmt::format("{:g} m/s: {} {}", condition.speed, name, exponent), shown(fit.value(exponent)), "",
       fit.is_at_end[0] || fit.is_at_end[1] ? "at the end of its range: not of this form"
                                            : fmt::format("{} = {:.3g} mm", size, 1e3 * fit.value(size))});
}

// Rosin and Rammler's between the floor and the largest piece, Gates, Gaudin and Schuhmann's between the floor and a
// quarter of the diameter: large pieces are a peak of their own.
void fit_laws(const Study& study, const Condition& condition, const std::vector<double>& sieves,
              const std::vector<double>& finer, double floor, PageSection& section, Json& json) {
  if (mean_of(study, condition.runs, "chipping_ratio") < least_loss) return;
  double largest = 0.0;
  for (const std::size_t i : condition.runs)
    largest = std::max(largest, study.runs[i].sizes.back().sieve_size / study.runs[i].diameter);
  const double diameter = study.runs[condition.runs.front()].diameter;
  std::vector<double> all, all_finer, fines, fines_finer;
  for (std::size_t i = 0; i < sieves.size(); ++i) {
    if (sieves[i] < floor || sieves[i] >= largest || finer[i] <= 0.0) continue;
    all.push_back(sieves[i] * diameter), all_finer.push_back(finer[i]);
    if (sieves[i] <= largest_fines) fines.push_back(all.back()), fines_finer.push_back(finer[i]);
  }
  constexpr std::size_t fewest = 4;
  if (all.size() >= fewest) {
    const Fit rosin = fit_rosin_rammler(all, all_finer);
    json["rosin_rammler"] = json_of(rosin);
    add_law(section, condition, "Rosin-Rammler", rosin, "n", "x63");
  }
  if (fines.size() >= fewest) {
    const Fit gates = fit_gates_gaudin_schuhmann(fines, fines_finer);
    json["gates_gaudin_schuhmann"] = json_of(gates);
    add_law(section, condition, "Gates-Gaudin-Schuhmann", gates, "m", "k");
  }
}

void add_distributions(Findings& findings, const Study& study, const Series& series, const std::string& suffix,
                       Json& json) {
  const std::vector<Condition> list = at_steepest_angle(series);
  const std::vector<double> sieves = sieve_series(largest_sieve, smallest_sieve);
  PageSection section{.title = titled("Size distributions", series)};
  section.paragraphs.push_back(
      fmt::format("Mass finer than a sieve, means over meshes and seeds at {:.3g}°. Below the resolution floor, the "
                  "mean edge of the coarsest mesh, pieces are products of the mesh. Where the mean loss is above 1 %, "
                  "Rosin and Rammler's law is fitted between the floor and the largest piece, Gates, Gaudin and "
                  "Schuhmann's to the fines, between the floor and a quarter of the diameter.",
                  list.front().angle / degree));
  PlotInput plot{.title = titled("size distributions", series),
                 .x_label = "size over the particle's diameter [-]",
                 .y_label = "mass fraction finer [-]",
                 .log_x = true,
                 .log_y = true};
  std::vector<std::vector<double>> rows;
  double floor = 0.0;
  for (const Condition& condition : list) {
    floor = std::max(floor, resolution_floor(study, condition.runs));
    const std::vector<double> finer = mean_passing(study, condition.runs, sieves);
    PlotSeries curve{.name = fmt::format("{:g} m/s", condition.speed)};
    for (std::size_t i = 0; i < sieves.size(); ++i) {
      rows.push_back(
          {condition.speed, sieves[i], finer[i], sieves[i] >= resolution_floor(study, condition.runs) ? 1.0 : 0.0});
      if (finer[i] >= 1e-4) curve.x.push_back(sieves[i]), curve.y.push_back(finer[i]);
    }
    if (!curve.x.empty()) plot.series.push_back(curve);
    Json& one = json["size_distributions"].emplace_back(Json{{"speed", condition.speed}});
    fit_laws(study, condition, sieves, finer, resolution_floor(study, condition.runs), section, one);
  }
  constexpr std::size_t most_curves = 8;
  if (plot.series.size() > most_curves)
    plot.series.erase(plot.series.begin(), plot.series.end() - most_curves);  // the faster ones
  plot.marks.push_back({floor, "resolution floor"});
  json["resolution_floor_over_diameter"] = floor;
  add_figure(findings, section, "size_distributions" + suffix, plot, "");
  write_table(findings.folder / ("size_distributions" + suffix + ".csv"),
              {"speed [m/s]", "size over diameter [-]", "finer [-]", "resolved [-]"}, rows);
  findings.sections.push_back(std::move(section));
}

void add_over_speed(Findings& findings, const Study& study, const Series& series, const std::string& suffix) {
  const std::vector<Condition> list = at_steepest_angle(series);
  const auto plot_of = [&](const std::vector<std::string>& names, const std::string& title,
                           const std::string& y_label) {
    PlotInput plot{.title = titled(title, series), .x_label = "impact speed [m/s]", .y_label = y_label};
    for (const std::string& name : names) {
      const PlotSeries points =
          points_of(study, list, name, words(name), [](const Condition& condition) { return condition.speed; });
      if (!points.x.empty()) plot.series.push_back(points);
    }
    join_points(plot);
    return plot;
  };
  PageSection section{.title = titled("Fineness, pieces and shapes", series)};
  std::string unresolved;
  for (const int n : fineness_divisors) {
    const std::string name = fmt::format("t{}", n);
    bool is_resolved = false;
    for (const Condition& condition : list)
      is_resolved = is_resolved || spread_of(study, condition, measure(name)).count > 0;
    if (!is_resolved) unresolved += (unresolved.empty() ? "" : ", ") + name;
  }
  section.paragraphs.push_back(
      "t_n is the mass fraction finer than 1/n of the particle's diameter." +
      (unresolved.empty() ? std::string() : " Not resolved by these meshes: " + unresolved + "."));
  add_figure(findings, section, "fineness" + suffix,
             plot_of({"t2", "t4", "t10", "t25", "t50", "t75"}, "fineness", "t_n [-]"), "");
  add_figure(findings, section, "pieces" + suffix,
             plot_of({"largest_mass_fraction", "second_mass_fraction", "unresolved_mass_fraction"},
                     "the largest pieces", "mass over the particle's [-]"),
             "");
  add_figure(findings, section, "shapes" + suffix,
             plot_of({"sphericity", "elongation", "flatness", "convexity"},
                     "shapes of the resolved pieces but the largest, by mass", "[-], 1 = sphere, equant, convex"),
             "");
  findings.sections.push_back(std::move(section));
}

}  // namespace

std::vector<double> mean_passing(const Study& study, const std::vector<std::size_t>& runs,
                                 const std::vector<double>& sieves_over_diameter) {
  std::vector<double> sum(sieves_over_diameter.size(), 0.0);
  for (const std::size_t i : runs) {
    std::vector<double> sieves = sieves_over_diameter;
    for (double& sieve : sieves) sieve *= study.runs[i].diameter;
    const std::vector<double> finer = passing(study.runs[i].sizes, sieves);
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += finer[k] / static_cast<double>(runs.size());
  }
  return sum;
}

double resolution_floor(const Study& study, const std::vector<std::size_t>& runs) {
  double floor = 0.0;
  for (const std::size_t i : runs) floor = std::max(floor, study.runs[i].element_size / study.runs[i].diameter);
  return floor;
}

void add_size_findings(Findings& findings, const Study& study) {
  const std::vector<Series> all = series_of(study);
  for (std::size_t k = 0; k < all.size(); ++k) {
    Json json{{"series", all[k].name}};
    add_distributions(findings, study, all[k], suffix_of(k, all.size()), json);
    add_over_speed(findings, study, all[k], suffix_of(k, all.size()));
    findings.json["sizes"].push_back(json);
  }
}

}  // namespace knap
