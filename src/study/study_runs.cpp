#include "study/study_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <set>
#include <tuple>

#include "analysis/size_fits.hpp"
#include "config/load_config.hpp"
#include "core/errors.hpp"
#include "io/csv_line.hpp"
#include "io/csv_table.hpp"

namespace knap {
namespace {

namespace fs = std::filesystem;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::array conditions_of_run{"impact.speed", "impact.angle", "impact.wall_friction"};

// Nothing for text, what is not finite or no number of its own (a hash may look like one).
std::optional<double> number_in(const std::string& column, const std::string& cell) {
  if (column == "state_hash" || column == "version") return std::nullopt;
  double value = 0.0;
  const char* end = cell.data() + cell.size();
  const auto [read, error] = std::from_chars(cell.data(), end, value);
  if (error != std::errc() || read != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

// "impact.speed" of "impact.speed [m/s]".
std::string key_of(const std::string& column) { return column.substr(0, column.find(' ')); }

bool is_seed(const std::string& key) { return key.ends_with("seed"); }
bool is_mesh(const std::string& key) { return key.starts_with("mesh.") || key.find(".mesh.") != std::string::npos; }

std::string short_name(const std::string& key) { return key.substr(key.rfind('.') + 1); }

// The keys that a campaign varies stand between `reason` and the first column of the reports.
std::vector<std::size_t> varied_columns(const std::vector<std::string>& columns) {
  std::vector<std::size_t> varied;
  for (std::size_t i = 3; i < columns.size() && columns[i] != "stop_reason" && columns[i] != "version"; ++i)
    varied.push_back(i);
  return varied;
}

StudyTable table_of(const fs::path& folder) {
  const fs::path file = folder / "results.csv";
  if (!fs::exists(file))
    throw InputError(fmt::format("{}: holds no results.csv: give the folder of a campaign", folder.string()));
  std::ifstream text(file);
  StudyTable table;
  for (std::string line; std::getline(text, line);) {
    if (trimmed(line).empty()) continue;
    std::vector<std::string> cells = csv_cells(line);
    if (table.columns.empty())
      table.columns = std::move(cells);
    else if (cells.size() == table.columns.size())
      table.rows.push_back(std::move(cells));
    else
      throw InputError(fmt::format("{}:{}: {} cells, the header has {}", file.string(), table.rows.size() + 2,
                                   cells.size(), table.columns.size()));
  }
  if (table.columns.size() < 3 || table.columns[0] != "run" || table.columns[1] != "state")
    throw InputError(fmt::format("{}: is not a campaign's table (run, state, reason, ...)", file.string()));
  return table;
}

void add_label(std::string& label, const std::string& key, const std::string& column, const std::string& cell) {
  const auto unit = column.find(" [");
  label += fmt::format("{}{} = {}{}", label.empty() ? "" : ", ", short_name(key), cell,
                       unit == std::string::npos ? "" : " " + column.substr(unit + 2, column.size() - unit - 3));
}

// Weighted by mass; the largest is what is left of the particle.
ShapeMeans shapes_in(const fs::path& fragments) {
  std::ifstream file(fragments);
  std::string line;
  std::getline(file, line);
  const std::vector<std::string> header = csv_cells(line);
  const auto column = [&](std::string_view name) {
    const auto found = std::find(header.begin(), header.end(), name);
    if (found == header.end()) throw InputError(fmt::format("{}: has no column {}", fragments.string(), name));
    return static_cast<std::size_t>(found - header.begin());
  };
  const std::array shape{column("sphericity [-]"), column("elongation [-]"), column("flatness [-]"),
                         column("convexity [-]")};
  const std::size_t mass = column("mass [kg]");
  std::array<double, 4> sums{};
  double total = 0.0;
  std::getline(file, line);
  while (std::getline(file, line)) {
    if (line.empty() || line.back() != '1') continue;  // `resolved` is the last column
    const std::vector<std::string> cells = csv_cells(line);
    if (cells.size() != header.size()) continue;
    const double weight = csv_number(cells[mass], fragments.string());
    total += weight;
    for (std::size_t k = 0; k < shape.size(); ++k) sums[k] += weight * csv_number(cells[shape[k]], fragments.string());
  }
  if (total == 0.0) return {nan, nan, nan, nan};
  return {sums[0] / total, sums[1] / total, sums[2] / total, sums[3] / total};
}

std::vector<SizeRow> sizes_in(const fs::path& file) {
  const CsvColumns columns = read_csv(file);
  if (columns.values.size() < 3 || columns.values[0].empty())
    throw InputError(fmt::format("{}: has no sizes", file.string()));
  std::vector<SizeRow> rows;
  for (std::size_t i = 0; i < columns.values[0].size(); ++i)
    rows.push_back({columns.values[0][i], columns.values[1][i], static_cast<Index>(columns.values[2][i])});
  return rows;
}

std::vector<ImpactRow> impacts_in(const fs::path& file) {
  if (!fs::exists(file)) return {};
  const CsvColumns columns = read_csv(file);
  const auto &mass = columns.column("mass_before [kg]"), &energy = columns.column("incident_energy [J]"),
             &chipping = columns.column("chipping_ratio [-]");
  std::vector<ImpactRow> rows;
  for (std::size_t i = 0; i < mass.size(); ++i) rows.push_back({chipping[i], energy[i] / mass[i]});
  return rows;
}

// Speed, angle and friction of an impact on the wall. Returns all else that the case says but mesh, seeds and output.
std::string read_case(StudyRun& run) {
  RunConfig config = load_config(run.folder / "effective.toml");
  if (has_wall(config) && config.particles.size() == 1) {
    run.has_wall = true;
    run.speed = config.impact.speed, run.angle = config.impact.angle, run.friction = config.impact.wall_friction;
    config.impact.speed = config.impact.angle = config.impact.wall_friction = 0.0;
  }
  for (ParticleConfig& particle : config.particles) {
    particle.mesh = {};
    particle.fracture.weibull_seed = not_given;
  }
  config.run = {}, config.output = {};
  return effective_toml(config);
}

StudyRun run_of(const fs::path& folder, const StudyTable& table, const std::vector<std::string>& cells) {
  StudyRun run{.name = cells[0], .folder = folder / "runs" / cells[0]};
  run.rest_of_case = read_case(run);
  for (const std::size_t i : varied_columns(table.columns)) {
    const std::string key = key_of(table.columns[i]);
    const bool is_condition =
        std::find(conditions_of_run.begin(), conditions_of_run.end(), key) != conditions_of_run.end();
    if (is_condition && run.has_wall) continue;
    add_label(is_seed(key) ? run.seed : is_mesh(key) ? run.mesh : run.series, key, table.columns[i], cells[i]);
  }
  for (std::size_t i = 3; i < cells.size(); ++i) {
    if (table.columns[i] == "breakage.class") run.breakage_class = cells[i];
    if (const auto number = number_in(table.columns[i], cells[i])) run.numbers[table.columns[i]] = *number;
  }
  run.diameter = run.number("sanity.diameter");
  run.element_size = run.number("mesh.edge_mean");
  if (!(run.diameter > 0.0) || !(run.element_size > 0.0))
    throw InputError("results.csv has no sanity.diameter and mesh.edge_mean above 0");
  run.impacts = impacts_in(run.folder / "impacts.csv");
  const fs::path pieces = run.impacts.empty() ? run.folder : run.folder / "impact_1";
  run.sizes = sizes_in(pieces / "size_distribution.csv");
  run.shape = shapes_in(pieces / "fragments.csv");
  return run;
}

// The default is the next finer sieve below what a whole particle passes: of the least broken run of its diameter.
void sieve_runs(Study& study) {
  std::map<double, const StudyRun*> wholest;
  for (const StudyRun& run : study.runs) {
    const StudyRun*& best = wholest[run.diameter];
    if (best == nullptr || run.sizes.back().sieve_size > best->sizes.back().sieve_size) best = &run;
  }
  for (StudyRun& run : study.runs) {
    const double whole = wholest[run.diameter]->sizes.back().sieve_size;
    if (study.sieve >= whole)
      throw InputError(fmt::format("the sieve of {:.4g} mm is not finer than the particle, which passes {:.4g} mm ({})",
                                   1e3 * study.sieve, 1e3 * whole, run.name));
    const std::array sieves{study.sieve > 0.0 ? study.sieve : std::min(whole, run.diameter) * std::exp2(-0.25)};
    run.breakage_ratio = passing(run.sizes, sieves)[0];
  }
}

// Campaigns that differ in what none of them varies are series of their own.
void part_campaigns(Study& study, const std::vector<std::string>& campaign_of_run) {
  std::map<std::string, std::set<std::string>> cases, campaigns;
  for (std::size_t i = 0; i < study.runs.size(); ++i) campaigns[study.runs[i].series].insert(campaign_of_run[i]);
  for (const StudyRun& run : study.runs) cases[run.series].insert(run.rest_of_case);
  for (std::size_t i = 0; i < study.runs.size(); ++i) {
    StudyRun& run = study.runs[i];
    const std::string series = run.series;
    if (campaigns[series].size() > 1 && cases[series].size() > 1)
      run.series += (series.empty() ? "" : ", ") + campaign_of_run[i];
  }
}

// Columns that only some campaigns have are empty for the others.
void add_table(StudyTable& all, const StudyTable& more, const std::string& prefix) {
  std::vector<std::size_t> place;
  for (const std::string& column : more.columns) {
    const auto found = std::find(all.columns.begin(), all.columns.end(), column);
    place.push_back(static_cast<std::size_t>(found - all.columns.begin()));
    if (found == all.columns.end()) all.columns.push_back(column);
  }
  for (auto& row : all.rows) row.resize(all.columns.size());
  for (const auto& row : more.rows) {
    all.rows.emplace_back(all.columns.size());
    for (std::size_t i = 0; i < row.size(); ++i) all.rows.back()[place[i]] = row[i];
    all.rows.back()[0] = prefix + row[0];
  }
}

}  // namespace

double StudyRun::number(const std::string& column) const {
  const auto found = numbers.find(column);
  return found == numbers.end() ? nan : found->second;
}

std::string folder_name(const fs::path& folder) {
  return (fs::absolute(folder) / "").lexically_normal().parent_path().filename().string();
}

Study read_study(std::span<const fs::path> folders, double sieve) {
  Study study{.sieve = sieve};
  std::vector<std::string> campaign_of_run;
  std::set<fs::path> seen;
  std::map<std::string, int> names;
  for (const fs::path& folder : folders) {
    if (fs::exists(folder) && !seen.insert(fs::canonical(folder)).second)
      throw InputError(fmt::format("{}: is given twice", folder.string()));
    const StudyTable table = table_of(folder);
    std::string name = folder_name(folder);
    if (const int number = ++names[name]; number > 1) name += fmt::format("-{}", number);
    const std::string prefix = folders.size() > 1 ? name + "/" : "";
    add_table(study.table, table, prefix);
    for (const auto& cells : table.rows) {
      if (cells[1] == "failed") ++study.failed;
      if (cells[1] == "waiting" || cells[1] == "running") ++study.waiting;
      if (cells[1] != "done") continue;
      try {
        study.runs.push_back(run_of(folder, table, cells));
        study.runs.back().name = prefix + study.runs.back().name;
        campaign_of_run.push_back(name);
      } catch (const InputError& error) {
        study.unreadable.push_back(fmt::format("{}{}: {}", prefix, cells[0], error.what()));
      }
    }
  }
  if (study.runs.empty())
    throw InputError(study.unreadable.empty() ? fmt::format("{}: no run is done yet", folders.front().string())
                                              : study.unreadable.front());
  sieve_runs(study);
  part_campaigns(study, campaign_of_run);
  return study;
}

std::vector<Condition> conditions(const Study& study) {
  std::map<std::tuple<std::string, double, double, double>, Condition> by_key;
  for (std::size_t i = 0; i < study.runs.size(); ++i) {
    const StudyRun& run = study.runs[i];
    Condition& condition = by_key[{run.series, run.friction, run.angle, run.speed}];
    condition.series = run.series;
    condition.speed = run.speed, condition.angle = run.angle, condition.friction = run.friction;
    condition.runs.push_back(i);
  }
  std::vector<Condition> list;
  for (auto& [key, condition] : by_key) list.push_back(std::move(condition));
  return list;
}

std::vector<Series> series_of(const Study& study) {
  const std::vector<Condition> all = conditions(study);
  std::set<double> frictions;
  for (const Condition& condition : all) frictions.insert(condition.friction);
  std::vector<Series> list;
  for (const Condition& condition : all) {
    std::string name = condition.series;
    if (frictions.size() > 1) name += fmt::format("{}wall friction {:g}", name.empty() ? "" : ", ", condition.friction);
    if (list.empty() || list.back().name != name) list.push_back({.name = name});
    list.back().conditions.push_back(condition);
  }
  return list;
}

}  // namespace knap
