#include "study/energy_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "study/condition_plots.hpp"
#include "study/summary_table.hpp"

namespace knap {

void add_energy_findings(Findings& findings, const Study& study) {
  const std::vector<Series> all = series_of(study);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const std::vector<Condition> list = at_steepest_angle(all[k]);
    double worst = 0.0;
    PlotInput plot{.title = titled("where the energy went", all[k]),
                   .x_label = "impact speed [m/s]",
                   .y_label = "over the incident energy [-]"};
    for (const char* term : {"kinetic", "cohesive_dissipated", "crack_friction", "closure_impact", "contact_dissipated",
                             "tool_friction", "strain", "viscous"}) {
      PlotSeries curve{.name = words(term)};
      for (const Condition& condition : list) {
        const Spread s = spread_of(study, condition, measure(std::string("energy_") + term));
        if (std::isfinite(s.mean)) curve.x.push_back(condition.speed), curve.y.push_back(s.mean);
      }
      if (!curve.y.empty() && *std::max_element(curve.y.begin(), curve.y.end()) > 0.002) plot.series.push_back(curve);
    }
    for (const Condition& condition : all[k].conditions)
      for (const double error : values_of(study, condition, measure("energy_closure_error").value))
        worst = std::isnan(error) ? error : std::max(worst, error);
    PageSection section{.title = titled("Energy", all[k])};
    section.rows.push_back(
        {"largest closure error of the ledger", shown(100.0 * worst) + " %", "", "of the incident energy"});
    add_figure(findings, section, "energy_split" + suffix_of(k, all.size()), plot,
               fmt::format("At the end of the runs, at {:.3g}°; terms below 0.2 % everywhere are left out.",
                           list.front().angle / degree));
    findings.sections.push_back(std::move(section));
  }
}

}  // namespace knap
