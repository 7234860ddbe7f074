#include "study/breakage_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "analysis/breakage_functions.hpp"
#include "analysis/population_balance.hpp"
#include "analysis/size_fits.hpp"
#include "core/errors.hpp"
#include "io/file_output.hpp"
#include "study/size_findings.hpp"

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
  Impacts impacts;
  for (const Condition& condition : series.conditions) impacts.angle = std::max(impacts.angle, condition.angle);
  for (const Condition& condition : series.conditions) {
    if (condition.angle != impacts.angle) continue;
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

/// The fits that could be made.
struct Fits {
  std::optional<Fit> vogel{}, shi{}, tavares{}, tavares_t10{}, damage{}, weibull{};
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
      fits.damage =
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

/// What broken particles became, over z = size over the particle's, between the floor and 1.
struct Measured {
  std::vector<double> z{}, finer{};
  double floor = 0.0;
};

Measured measured_over_size(const Study& study, const Impacts& impacts) {
  std::vector<std::size_t> broken;
  for (std::size_t k = 0; k < impacts.runs.size(); ++k)
    if (impacts.outcomes[k]) broken.push_back(impacts.runs[k]);
  Measured measured;
  if (broken.empty()) return measured;
  measured.floor = resolution_floor(study, broken);
  if (measured.floor >= 1.0) return measured;
  measured.z = sieve_series(1.0, measured.floor);
  measured.finer = mean_passing(study, broken, measured.z);
  measured.finer.front() = 1.0;  // B(y|y) = 1: what is broken of a class is at most as large as the class
  return measured;
}

void export_balance(Findings& findings, PageSection& section, const Series& series, const Study& study,
                    const Impacts& impacts, const Fits& fits, const std::string& suffix, Json& json) {
  const Measured measured = measured_over_size(study, impacts);
  if (measured.z.size() < 4 || !fits.vogel) {
    section.paragraphs.push_back("No population balance is exported: the mesh resolves too few sieves of the pieces.");
    return;
  }
  const Fit fit = fit_breakage_distribution(measured.z, measured.finer),
            austin = fit_austin(measured.z, measured.finer);
  add_values(section, "B(x|y), tanh", fit);
  add_values(section, "B(x|y), two terms", austin);
  const auto rms = [&](const Fit& of) { return std::sqrt(of.loss / static_cast<double>(of.num_data)); };
  section.rows.push_back({"B(x|y): rms of the fits, tanh and two terms",
                          fmt::format("{:.2g}, {:.2g}", rms(fit), rms(austin)), "",
                          "the matrix is of the measured distribution itself"});
  json["breakage_distribution"] = json_of(fit), json["breakage_distribution"]["rms"] = rms(fit);
  json["breakage_distribution_two_terms"] = json_of(austin),
  json["breakage_distribution_two_terms"]["rms"] = rms(austin);
  const auto tanh_law = [&](double z) { return breakage_distribution(z, fit.value("q"), fit.value("r")); };
  const auto two_terms = [&](double z) {
    return austin_distribution(z, austin.value("phi"), austin.value("g"), austin.value("b"));
  };
  const std::vector<double> at(measured.z.rbegin(), measured.z.rend()),
      finer(measured.finer.rbegin(), measured.finer.rend());
  const double diameter = study.runs[impacts.runs.front()].diameter;
  SizeClasses classes;
  for (const double z : measured.z) classes.edges.push_back(z * diameter);
  const Eigen::MatrixXd breakage =
      breakage_matrix(classes, [&](double z) { return measured_distribution(z, at, finer); });
  // Selection of each class for a row of energies: f_mat and x W_min are the material's.
  constexpr int num_energies = 25;
  std::vector<std::vector<double>> selection_rows, breakage_rows;
  double worst = 0.0;
  Json selection_json = Json::array();
  for (int k = 0; k <= num_energies; ++k) {
    const double energy = impacts.largest_energy * k / num_energies;
    std::vector<double> row{energy};
    for (const double x : classes.edges)
      row.push_back(
          vogel_peukert(energy, fits.vogel->value("f_x") * x / diameter, fits.vogel->value("W_min") * diameter / x));
    Eigen::VectorXd selection =
        Eigen::Map<const Eigen::VectorXd>(row.data() + 1, static_cast<Eigen::Index>(classes.size()));
    selection[selection.size() - 1] = 0.0;  // the pan stays
    row.back() = 0.0;
    const Eigen::VectorXd masses =
        Eigen::VectorXd::Constant(selection.size(), 1.0 / static_cast<double>(selection.size()));
    worst = std::max(worst, std::abs(ground(masses, selection, breakage).sum() - 1.0));
    selection_json.push_back(std::vector<double>(row.begin() + 1, row.end()));
    selection_rows.push_back(std::move(row));
  }
  constexpr double allowed = 1e-12;
  if (!breakage.allFinite() || breakage.minCoeff() < -allowed)
    throw RuntimeFailure("population balance: a class of the breakage matrix is negative or no number");
  if (worst > allowed)
    throw RuntimeFailure(fmt::format("population balance: a step of grinding changes the mass by {:.1e}", worst));
  std::vector<std::string> selection_columns{"energy [J/kg]"}, breakage_columns{"upper edge [m]"};
  for (const double x : classes.edges) {
    selection_columns.push_back(fmt::format("S at x = {:.6g} m [-]", x));
    breakage_columns.push_back(fmt::format("b from y = {:.6g} m [-]", x));
  }
  Json matrix = Json::array(), energies = Json::array();
  for (const auto& row : selection_rows) energies.push_back(row[0]);
  for (Eigen::Index i = 0; i < breakage.rows(); ++i) {
    breakage_rows.push_back({classes.edges[static_cast<std::size_t>(i)]});
    matrix.push_back(Json::array());
    for (Eigen::Index j = 0; j < breakage.cols(); ++j)
      breakage_rows.back().push_back(breakage(i, j)), matrix.back().push_back(breakage(i, j));
  }
  write_table(findings.folder / ("selection" + suffix + ".csv"), selection_columns, selection_rows);
  write_table(findings.folder / ("breakage" + suffix + ".csv"), breakage_columns, breakage_rows);
  const Json laws{{{"law", "B = (x/y)^q (1 + tanh((x - x')/x')) over its value at x = y, x' = r y"},
                   {"q", fit.value("q")},
                   {"r", fit.value("r")},
                   {"rms", rms(fit)}},
                  {{"law", "B = phi (x/y)^g + (1 - phi) (x/y)^b (Austin, Klimpel & Luckie 1984)"},
                   {"phi", austin.value("phi")},
                   {"g", austin.value("g")},
                   {"b", austin.value("b")},
                   {"rms", rms(austin)}}};
  const Json balance{
      {"units",
       {{"size", "m"},
        {"energy", "J/kg"},
        {"selection", "-, broken mass over the class's, one impact"},
        {"breakage", "-, row i of column j: mass that goes to class i of what is broken of class j"}}},
      {"sizes", classes.edges},
      {"last_class", "all that passes the last edge, the resolution floor of the meshes"},
      {"energies", energies},
      {"selection", selection_json},
      {"breakage", matrix},
      {"selection_law",
       {{"law", "S = 1 - exp(-f_mat x (W - W_min)), x W_min constant (Vogel & Peukert 2003)"},
        {"f_mat_kg_per_J_m", fits.vogel->value("f_x") / diameter},
        {"x_W_min_J_m_per_kg", fits.vogel->value("W_min") * diameter}}},
      {"breakage_is", "the mean of the broken particles, between sieves by straight lines of the logarithms"},
      {"breakage_laws", laws},
      {"selection_is_resolved", fits.vogel->covariance.size() > 0},
      {"assumption", "particles of all sizes break alike: only one size was run"},
      {"mass_error_of_one_step", worst}};
  write_text_atomically(findings.folder / ("population_balance" + suffix + ".json"), balance.dump(1) + "\n");
  json["population_balance"] = {{"file", "population_balance" + suffix + ".json"}, {"mass_error_of_one_step", worst}};
  section.rows.push_back({"population balance: mass error of one step of grinding", fmt::format("{:.1g}", worst), "",
                          fmt::format("population_balance{0}.json, selection{0}.csv, breakage{0}.csv", suffix)});
  const PlotSeries points{
      .name = "broken particles", .x = measured.z, .y = measured.finer, .style = PlotSeries::Style::Points};
  add_fit_figures(findings, section, "breakage_distribution" + suffix,
                  {.title = titled("breakage distribution", series),
                   .x_label = "size over the particle's [-]",
                   .y_label = "B(x|y) [-]",
                   .marks = {{measured.floor, "resolution floor"}}},
                  points, {{"tanh", tanh_law}, {"two terms", two_terms}}, "");
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
    section.paragraphs.push_back(fmt::format(
        "Of the impacts at {:.3g}°. A particle is broken that has lost {:g} % of its mass (Tavares & King 1998). W = "
        "v²/2 is the "
        "energy of the impact over the particle's mass. Values ± standard errors; covariances are in analysis.json.",
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
      export_balance(findings, section, series, study, impacts, fits, suffix, json);
    }
    findings.json["breakage_functions"].push_back(json);
    findings.sections.push_back(std::move(section));
  }
}

}  // namespace knap
