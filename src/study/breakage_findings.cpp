#include "study/breakage_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "analysis/breakage_functions.hpp"
#include "study/balance_findings.hpp"
#include "study/condition_plots.hpp"

namespace knap {
namespace {

using Json = nlohmann::ordered_json;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The impacts at the steepest angle.
struct Impacts {
  double angle = 0.0;
  std::vector<std::size_t> runs{};  // of the study
  std::vector<EnergyImpact> list{};
  std::vector<double> speeds{};
  std::vector<bool> outcomes{};
  double largest_energy = 0.0;
};

Impacts impacts_of(const Study& study, const Series& series, double broken) {
  const std::vector<Condition> list = at_steepest_angle(series);
  Impacts impacts{.angle = list.front().angle};
  for (const Condition& condition : list) {
    for (const std::size_t i : condition.runs) {
      const StudyRun& run = study.runs[i];
      if (!std::isfinite(run.chipping_ratio())) continue;
      const bool is_broken = run.chipping_ratio() >= broken;
      const double energy = 0.5 * run.speed * run.speed;
      impacts.runs.push_back(i);
      impacts.list.push_back({energy, is_broken, run.number("breakage.t10")});
      impacts.speeds.push_back(run.speed);
      impacts.outcomes.push_back(is_broken);
      impacts.largest_energy = std::max(impacts.largest_energy, energy);
    }
  }
  return impacts;
}

// The share of broken ones at each speed, with Wilson's 95 % interval (1927).
PlotSeries measured_share(const Impacts& impacts, bool over_energy) {
  std::map<double, std::pair<double, double>> counts;
  for (std::size_t i = 0; i < impacts.speeds.size(); ++i) {
    auto& [broken, all] = counts[impacts.speeds[i]];
    broken += impacts.outcomes[i] ? 1.0 : 0.0, ++all;
  }
  PlotSeries points{.name = "runs", .style = PlotSeries::Style::Points};
  constexpr double z = 1.96;
  for (const auto& [speed, count] : counts) {
    const auto& [broken, n] = count;
    const double p = broken / n, centre = (p + z * z / (2.0 * n)) / (1.0 + z * z / n);
    const double half = z / (1.0 + z * z / n) * std::sqrt(p * (1.0 - p) / n + z * z / (4.0 * n * n));
    points.x.push_back(over_energy ? 0.5 * speed * speed : speed);
    points.y.push_back(p);
    points.low.push_back(std::max(0.0, centre - half)), points.high.push_back(std::min(1.0, centre + half));
  }
  return points;
}

/// The fits that could be made and that are drawn.
struct Fits {
  std::optional<Fit> vogel{}, shi{}, tavares{}, tavares_t10{}, weibull{};
};

// t_10 and fits that lack data say so instead of stopping the study.
template <class Make>
std::optional<Fit> made(const std::string& law, PageSection& section, Json& json, const std::string& key,
                        const Make& make) {
  try {
    Fit fit = make();
    add_rows(section, law, fit);
    json[key] = json_of(fit);
    return fit;
  } catch (const std::invalid_argument& reason) {
    section.rows.push_back({law, "not fitted", "", reason.what()});
    json[key] = {{"not_fitted", reason.what()}};
    return std::nullopt;
  }
}

std::vector<RepeatedImpacts> repeated_of(const Study& study, const Impacts& impacts, double broken) {
  std::vector<RepeatedImpacts> particles;
  for (const std::size_t i : impacts.runs) {
    const StudyRun& run = study.runs[i];
    if (run.impacts.size() < 2) continue;
    RepeatedImpacts particle{.energy = run.impacts.front().specific_energy};
    for (const ImpactRow& impact : run.impacts) {
      ++particle.impacts;
      particle.is_broken = impact.chipping_ratio >= broken;
      if (particle.is_broken) break;
    }
    particles.push_back(particle);
  }
  return particles;
}

Fits fits_of(const Study& study, const Impacts& impacts, double broken, PageSection& section, Json& json) {
  Fits fits;
  fits.vogel = made("Vogel-Peukert", section, json, "vogel_peukert", [&] { return fit_vogel_peukert(impacts.list); });
  fits.shi = made("Shi-Kojovic t10", section, json, "shi_kojovic", [&] { return fit_shi_kojovic(impacts.list); });
  fits.tavares = made("Tavares", section, json, "tavares", [&] { return fit_tavares(impacts.list); });
  if (fits.tavares) {
    const double e50 = fits.tavares->value("E50"), sigma = fits.tavares->value("sigma");
    fits.tavares_t10 =
        made("Tavares t10", section, json, "tavares_t10", [&] { return fit_tavares_t10(impacts.list, e50, sigma); });
    const std::vector<RepeatedImpacts> particles = repeated_of(study, impacts, broken);
    if (particles.empty()) {
      json["tavares_damage"] = {{"not_fitted", "no repeated impacts"}};
      section.rows.push_back({"Tavares: damage", "not fitted", "", "no run has impact.repeat above 1"});
    } else {
      made("Tavares: damage", section, json, "tavares_damage", [&] { return fit_damage(particles, e50, sigma); });
    }
  }
  fits.weibull = made("Weibull in speed", section, json, "weibull_in_speed",
                      [&] { return fit_speed_weibull(impacts.speeds, impacts.outcomes); });
  return fits;
}

void draw_probability(Findings& findings, PageSection& section, const Series& series, const Impacts& impacts,
                      const Fits& fits, const std::string& suffix) {
  std::vector<DrawnLaw> laws;
  if (fits.vogel)
    laws.push_back({"Vogel-Peukert",
                    [&](double w) { return vogel_peukert(w, fits.vogel->value("f_x"), fits.vogel->value("W_min")); }});
  if (fits.tavares)
    laws.push_back({"Tavares", [&](double w) {
                      return tavares_probability(w, fits.tavares->value("E50"), fits.tavares->value("sigma"), infinity);
                    }});
  add_fit_figures(findings, section, "breakage_probability" + suffix,
                  {.title = titled("breakage probability over energy", series),
                   .x_label = "specific impact energy [J/kg]",
                   .y_label = "probability [-]"},
                  measured_share(impacts, true), laws, "Bars: Wilson's 95 % interval of a share.");
  if (!fits.weibull) return;
  const DrawnLaw weibull{"Weibull", [&](double v) {
                           return -std::expm1(-std::pow(v / fits.weibull->value("v_s"), fits.weibull->value("m")));
                         }};
  add_fit_figures(findings, section, "breakage_probability_over_speed" + suffix,
                  {.title = titled("breakage probability over speed", series),
                   .x_label = "impact speed [m/s]",
                   .y_label = "probability [-]"},
                  measured_share(impacts, false), {weibull}, "");
}

void draw_t10(Findings& findings, PageSection& section, const Series& series, const Impacts& impacts, const Fits& fits,
              const std::string& suffix) {
  PlotSeries points{.name = "runs", .style = PlotSeries::Style::Points};
  double least_broken = impacts.largest_energy;
  for (const EnergyImpact& impact : impacts.list) {
    if (std::isfinite(impact.t10)) points.x.push_back(impact.energy), points.y.push_back(impact.t10);
    if (impact.is_broken) least_broken = std::min(least_broken, impact.energy);
  }
  if (!fits.shi) return;
  std::vector<DrawnLaw> laws{{"Shi-Kojovic", [&](double w) {
                                return fits.shi->value("M") *
                                       vogel_peukert(w, fits.shi->value("f_x"), fits.shi->value("W_min"));
                              }}};
  if (fits.tavares && fits.tavares_t10)
    laws.push_back({"Tavares",
                    [&](double w) {
                      const double e50b =
                          median_broken_energy(w, fits.tavares->value("E50"), fits.tavares->value("sigma"));
                      return fits.tavares_t10->value("A") * -std::expm1(-fits.tavares_t10->value("b'") * w / e50b);
                    },
                    least_broken});
  add_fit_figures(
      findings, section, "t10" + suffix,
      {.title = titled("t10 over energy", series), .x_label = "specific impact energy [J/kg]", .y_label = "t10 [-]"},
      points, laws, "Tavares' law is of the broken particles alone.");
}

// Shi & Kojovic's A b = 3600 M f_mat x, M in per cent: that of the drop-weight tests, A in %, b in t/kWh.
void add_derived(const Fits& fits, double diameter, PageSection& section, Json& json) {
  if (fits.vogel) {
    json["f_mat"] = {{"value", fits.vogel->value("f_x") / diameter}, {"unit", "kg/(J m)"}};
    json["x_W_min"] = {{"value", fits.vogel->value("W_min") * diameter}, {"unit", "J m/kg"}};
    section.rows.push_back(
        {"Vogel-Peukert: f_mat", fmt::format("{:.4g} kg/(J m)", fits.vogel->value("f_x") / diameter), "", ""});
    section.rows.push_back(
        {"Vogel-Peukert: x W_min", fmt::format("{:.4g} J m/kg", fits.vogel->value("W_min") * diameter), "", ""});
  }
  if (fits.shi) {
    const double product = 3600.0 * 100.0 * fits.shi->value("M") * fits.shi->value("f_x");
    json["A_b"] = {{"value", product}, {"unit", "% t/kWh"}};
    section.rows.push_back({"Shi-Kojovic: A b", fmt::format("{:.3g} % t/kWh", product), "", ""});
  }
}

BalanceInput balance_input(const Study& study, const Impacts& impacts, const Fit& vogel, const std::string& suffix) {
  BalanceInput input{.diameter = study.runs[impacts.runs.front()].diameter,
                     .largest_energy = impacts.largest_energy,
                     .selection = vogel,
                     .suffix = suffix};
  for (std::size_t k = 0; k < impacts.runs.size(); ++k)
    if (impacts.outcomes[k]) input.broken.push_back(impacts.runs[k]);
  return input;
}

}  // namespace

void add_breakage_findings(Findings& findings, const Study& study, double broken) {
  const std::vector<Series> all = series_of(study);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Series& series = all[k];
    const std::string suffix = suffix_of(k, all.size());
    const Impacts impacts = impacts_of(study, series, broken);
    if (impacts.largest_energy <= 0.0) continue;
    Json json{{"series", series.name}, {"angle_deg", impacts.angle / degree}, {"broken_from_mass_loss", broken}};
    PageSection section{.title = titled("Breakage functions", series)};
    section.paragraphs.push_back(
        fmt::format("Of the impacts at {:.3g}°. A particle is broken that has lost {:g} % of its mass (Tavares & King "
                    "1998). W = v²/2 is the energy of the impact over the particle's mass. Values ± standard errors; "
                    "covariances are in analysis.json.",
                    impacts.angle / degree, 100.0 * broken));
    const auto num_broken = std::count(impacts.outcomes.begin(), impacts.outcomes.end(), true);
    if (num_broken == 0 || num_broken == static_cast<std::ptrdiff_t>(impacts.outcomes.size())) {
      const std::string reason = num_broken == 0 ? "no particle is broken" : "every particle is broken";
      section.paragraphs.push_back("Not fitted: " + reason + ". Run speeds on both sides of the threshold.");
      json["not_fitted"] = reason;
    } else {
      const Fits fits = fits_of(study, impacts, broken, section, json);
      add_derived(fits, study.runs[impacts.runs.front()].diameter, section, json);
      draw_probability(findings, section, series, impacts, fits, suffix);
      draw_t10(findings, section, series, impacts, fits, suffix);
      if (fits.vogel)
        add_population_balance(findings, section, study, series, balance_input(study, impacts, *fits.vogel, suffix),
                               json);
    }
    findings.json["breakage_functions"].push_back(json);
    findings.sections.push_back(std::move(section));
  }
}

}  // namespace knap
