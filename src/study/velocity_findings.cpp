#include "study/velocity_findings.hpp"

#include "study/breakage_curves.hpp"
#include "study/collapse_findings.hpp"
#include "study/condition_plots.hpp"
#include "study/equal_loss_findings.hpp"
#include "study/tangential_findings.hpp"

namespace knap {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

void add_velocity_findings(Findings& findings, const Study& study, const std::vector<double>& normal_speeds,
                           int collapse_samples) {
  const std::vector<Series> all = series_of(study);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Series& series = all[k];
    if (series.conditions.size() < 2 || series.conditions.front().speed <= 0.0) continue;
    const std::string suffix = suffix_of(k, all.size());
    Json json{{"series", series.name}};
    add_breakage_curves(findings, study, series, suffix, json);
    if (angles_of(series).size() > 1) {
      if (series.conditions.front().friction > 0.0) {
        add_collapse(findings, study, series, suffix, collapse_samples, json);
        add_equal_loss(findings, study, series, suffix, json);
        add_tangential(findings, study, series, normal_speeds, suffix, json);
      } else {
        add_frictionless(findings, study, series, json);
      }
    }
    findings.json["velocity"].push_back(json);
  }
  add_known_friction(findings, study, collapse_samples);
}

}  // namespace knap
