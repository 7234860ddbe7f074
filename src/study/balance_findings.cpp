#include "study/balance_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/breakage_functions.hpp"
#include "analysis/population_balance.hpp"
#include "analysis/size_fits.hpp"
#include "core/errors.hpp"
#include "io/file_output.hpp"
#include "study/size_findings.hpp"

namespace knap {
namespace {

using Json = nlohmann::ordered_json;

/// What broken particles became, over z = size over the particle's, descending from 1 to the floor.
struct Measured {
  std::vector<double> z{}, finer{};
  double floor = 0.0;
};

Measured measured_over_size(const Study& study, const std::vector<std::size_t>& broken) {
  Measured measured{.floor = resolution_floor(study, broken)};
  if (broken.empty() || measured.floor >= 1.0) return measured;
  measured.z = sieve_series(1.0, measured.floor);
  measured.finer = mean_passing(study, broken, measured.z);
  measured.finer.front() = 1.0;  // B(y|y) = 1: what is broken of a class is at most as large as the class
  return measured;
}

/// The two laws that tell it.
struct SizeLaws {
  Fit tanh{}, two_terms{};

  double by_tanh(double z) const { return breakage_distribution(z, tanh.value("q"), tanh.value("r")); }
  double by_two_terms(double z) const {
    return austin_distribution(z, two_terms.value("phi"), two_terms.value("g"), two_terms.value("b"));
  }
};

double rms_of(const Fit& fit) { return std::sqrt(fit.loss / static_cast<double>(fit.num_data)); }

SizeLaws add_size_laws(PageSection& section, const Measured& measured, Json& json) {
  const SizeLaws laws{fit_breakage_distribution(measured.z, measured.finer), fit_austin(measured.z, measured.finer)};
  add_values(section, "B(x|y), tanh", laws.tanh);
  add_values(section, "B(x|y), two terms", laws.two_terms);
  section.rows.push_back({"B(x|y): rms of the fits, tanh and two terms",
                          fmt::format("{:.2g}, {:.2g}", rms_of(laws.tanh), rms_of(laws.two_terms)), "",
                          "the matrix is of the measured distribution itself"});
  json["breakage_distribution"] = json_of(laws.tanh);
  json["breakage_distribution"]["rms"] = rms_of(laws.tanh);
  json["breakage_distribution_two_terms"] = json_of(laws.two_terms);
  json["breakage_distribution_two_terms"]["rms"] = rms_of(laws.two_terms);
  return laws;
}

struct Balance {
  SizeClasses classes{};
  std::vector<double> energies{};            // [J/kg]
  std::vector<Eigen::VectorXd> selection{};  // of the classes, by energy
  Eigen::MatrixXd breakage{};
  double mass_error = 0.0;  // of a step of grinding, over the mass
};

// f_mat and x W_min are the material's; the pan stays as it is.
Eigen::VectorXd selection_of(const SizeClasses& classes, double energy, const BalanceInput& input) {
  const double f_x = input.selection.value("f_x"), least = input.selection.value("W_min");
  Eigen::VectorXd selection(static_cast<Eigen::Index>(classes.size()));
  for (Eigen::Index i = 0; i < selection.size(); ++i) {
    const double part = classes.edges[static_cast<std::size_t>(i)] / input.diameter;
    selection[i] = vogel_peukert(energy, f_x * part, least / part);
  }
  selection[selection.size() - 1] = 0.0;
  return selection;
}

Balance balance_of(const Measured& measured, const BalanceInput& input) {
  constexpr int num_energies = 25;
  const std::vector<double> z(measured.z.rbegin(), measured.z.rend()),
      finer(measured.finer.rbegin(), measured.finer.rend());
  Balance balance;
  for (const double size : measured.z) balance.classes.edges.push_back(size * input.diameter);
  balance.breakage = breakage_matrix(balance.classes, [&](double at) { return measured_distribution(at, z, finer); });
  const auto n = static_cast<Eigen::Index>(balance.classes.size());
  const Eigen::VectorXd masses = Eigen::VectorXd::Constant(n, 1.0 / static_cast<double>(n));
  for (int k = 0; k <= num_energies; ++k) {
    balance.energies.push_back(input.largest_energy * k / num_energies);
    balance.selection.push_back(selection_of(balance.classes, balance.energies.back(), input));
    const double mass = ground(masses, balance.selection.back(), balance.breakage).sum();
    balance.mass_error = std::max(balance.mass_error, std::abs(mass - 1.0));
  }
  return balance;
}

void check(const Balance& balance) {
  constexpr double allowed = 1e-12;
  if (!balance.breakage.allFinite() || balance.breakage.minCoeff() < -allowed)
    throw RuntimeFailure("population balance: a class of the breakage matrix is negative or no number");
  if (balance.mass_error > allowed)
    throw RuntimeFailure(
        fmt::format("population balance: a step of grinding changes the mass by {:.1e}", balance.mass_error));
}

std::vector<double> list_of(const Eigen::VectorXd& vector) { return {vector.begin(), vector.end()}; }

void write_tables(const Findings& findings, const Balance& balance, const std::string& suffix) {
  std::vector<std::string> selection_columns{"energy [J/kg]"}, breakage_columns{"upper edge [m]"};
  for (const double x : balance.classes.edges) {
    selection_columns.push_back(fmt::format("S at x = {:.6g} m [-]", x));
    breakage_columns.push_back(fmt::format("b from y = {:.6g} m [-]", x));
  }
  const auto row_of = [](double first, const Eigen::VectorXd& rest) {
    std::vector<double> row{first};
    row.insert(row.end(), rest.begin(), rest.end());
    return row;
  };
  std::vector<std::vector<double>> selection_rows, breakage_rows;
  for (std::size_t k = 0; k < balance.energies.size(); ++k)
    selection_rows.push_back(row_of(balance.energies[k], balance.selection[k]));
  for (Eigen::Index i = 0; i < balance.breakage.rows(); ++i)
    breakage_rows.push_back(row_of(balance.classes.edges[static_cast<std::size_t>(i)], balance.breakage.row(i)));
  write_table(findings.folder / ("selection" + suffix + ".csv"), selection_columns, selection_rows);
  write_table(findings.folder / ("breakage" + suffix + ".csv"), breakage_columns, breakage_rows);
}

// Whether the data determine every value of a fit.
bool is_resolved(const Fit& fit) { return fit.covariance.size() > 0; }

Json law_json(const std::string& law, const Fit& fit) {
  Json json{{"law", law}};
  for (std::size_t i = 0; i < fit.values.size(); ++i) json[fit.parameters[i].name] = fit.values[i];
  json["rms"] = rms_of(fit);
  return json;
}

Json balance_json(const Balance& balance, const BalanceInput& input, const SizeLaws& laws) {
  Json selection = Json::array(), breakage = Json::array();
  for (const Eigen::VectorXd& row : balance.selection) selection.push_back(list_of(row));
  for (Eigen::Index i = 0; i < balance.breakage.rows(); ++i) breakage.push_back(list_of(balance.breakage.row(i)));
  const Fit& vogel = input.selection;
  return {{"units",
           {{"size", "m"},
            {"energy", "J/kg"},
            {"selection", "-, broken mass over the class's, one impact"},
            {"breakage", "-, row i of column j: mass that goes to class i of what is broken of class j"}}},
          {"sizes", balance.classes.edges},
          {"last_class", "all that passes the last edge, the resolution floor of the meshes"},
          {"energies", balance.energies},
          {"selection", selection},
          {"breakage", breakage},
          {"selection_law",
           {{"law", "S = 1 - exp(-f_mat x (W - W_min)), x W_min constant (Vogel & Peukert 2003)"},
            {"f_mat_kg_per_J_m", vogel.value("f_x") / input.diameter},
            {"x_W_min_J_m_per_kg", vogel.value("W_min") * input.diameter}}},
          {"selection_is_resolved", is_resolved(vogel)},
          {"breakage_is", "the mean of the broken particles, between sieves by straight lines of the logarithms"},
          {"breakage_laws",
           {law_json("B = (x/y)^q (1 + tanh((x - x')/x')) over its value at x = y, x' = r y", laws.tanh),
            law_json("B = phi (x/y)^g + (1 - phi) (x/y)^b (Austin, Klimpel & Luckie 1984)", laws.two_terms)}},
          {"assumption", "particles of all sizes break alike: only one size was run"},
          {"mass_error_of_one_step", balance.mass_error}};
}

}  // namespace

void add_population_balance(Findings& findings, PageSection& section, const Study& study, const Series& series,
                            const BalanceInput& input, Json& json) {
  constexpr std::size_t fewest = 4;
  const Measured measured = measured_over_size(study, input.broken);
  if (measured.z.size() < fewest) {
    section.paragraphs.push_back("No population balance is exported: the mesh resolves too few sieves of the pieces.");
    return;
  }
  const SizeLaws laws = add_size_laws(section, measured, json);
  const Balance balance = balance_of(measured, input);
  check(balance);
  write_tables(findings, balance, input.suffix);
  const std::string file = "population_balance" + input.suffix + ".json";
  write_text_atomically(findings.folder / file, balance_json(balance, input, laws).dump(1) + "\n");
  json["population_balance"] = {{"file", file}, {"mass_error_of_one_step", balance.mass_error}};
  section.rows.push_back({"population balance: mass error of one step of grinding",
                          fmt::format("{:.1g}", balance.mass_error), "",
                          fmt::format("{0}, breakage{1}.csv, selection{1}.csv{2}", file, input.suffix,
                                      is_resolved(input.selection) ? "" : ": the data leave f_mat or W_min open")});
  const PlotSeries points{
      .name = "broken particles", .x = measured.z, .y = measured.finer, .style = PlotSeries::Style::Points};
  add_fit_figures(findings, section, "breakage_distribution" + input.suffix,
                  {.title = titled("breakage distribution", series),
                   .x_label = "size over the particle's [-]",
                   .y_label = "B(x|y) [-]",
                   .marks = {{measured.floor, "resolution floor"}}},
                  points,
                  {{"tanh", [&](double z) { return laws.by_tanh(z); }},
                   {"two terms", [&](double z) { return laws.by_two_terms(z); }}},
                  "");
}

}  // namespace knap
