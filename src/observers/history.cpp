#include "observers/history.hpp"

#include <fmt/format.h>

#include "io/csv_line.hpp"
#include "observers/fragment_census.hpp"

namespace knap {
namespace {

constexpr std::size_t step_column = 0;
constexpr std::size_t time_column = 1;
constexpr std::size_t sums_column = 2;  // x, y, z of each tool's impulse and moment
constexpr std::size_t sums_of_a_tool = 2;

void add_names(std::vector<std::string>& names, const std::string& tool, const char* what, const char* unit) {
  for (const char axis : {'x', 'y', 'z'}) names.push_back(fmt::format("{}_{}_{} [{}]", tool, what, axis, unit));
}

bool moves(const Simulation& s, std::size_t tool) {
  return !std::holds_alternative<AtRest>(s.options.tools[tool].motion);
}

std::vector<std::string> column_names(const Simulation& s) {
  std::vector<std::string> names{"step", "time [s]"};
  for (const Tool& tool : s.tools) {
    add_names(names, tool.name, "impulse", "N s");
    add_names(names, tool.name, "moment", "N m s");
  }
  for (std::size_t term = 0; term < num_energy_terms; ++term)
    names.push_back(fmt::format("{} [J]", name(static_cast<EnergyTerm>(term))));
  names.insert(names.end(), {"energy_sum [J]", "closure_error [-]"});
  for (std::size_t k = 0; k < s.tools.size(); ++k) {
    const std::string& tool = s.tools[k].name;
    add_names(names, tool, "force", "N");
    add_names(names, tool, "torque", "N m");
    if (!moves(s, k)) continue;
    names.push_back(fmt::format("{}_work [J]", tool));
    add_names(names, tool, "displacement", "m");
  }
  for (const char* other : {"restitution [-]", "cracked_area [m2]", "cracked_area_mode_i [m2]",
                            "cracked_area_mode_ii [m2]", "failed_area [m2]", "fragments [-]", "inserted_facets [-]"})
    names.emplace_back(other);
  return names;
}

void add_cells(std::vector<CsvCell>& cells, const Vec3& a) { cells.insert(cells.end(), {a.x(), a.y(), a.z()}); }

// The data lines of a file, complete ones only; none if there is no file.
std::vector<std::string> complete_rows(const std::filesystem::path& path) {
  std::vector<std::string> rows;
  if (!std::filesystem::exists(path)) return rows;
  const std::string text = read_text(path);
  for (std::size_t begin = 0, end = 0; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1)
    rows.push_back(text.substr(begin, end - begin));
  if (!rows.empty()) rows.erase(rows.begin());
  return rows;
}

}  // namespace

History::History(std::filesystem::path path, std::int64_t interval, std::int64_t ledger_interval)
    : Observer(1),
      path_(std::move(path)),
      interval_(std::max<std::int64_t>(1, (interval + ledger_interval - 1) / ledger_interval) * ledger_interval) {}

void History::resume(std::int64_t step, std::size_t num_tools) {
  last_sums_.assign(sums_of_a_tool * num_tools, Vec3::Zero());
  const auto rows = complete_rows(path_);
  std::size_t kept = 0;
  for (; kept < rows.size(); ++kept) {
    const auto cells = csv_cells(rows[kept]);
    const auto number = [&](std::size_t column) { return csv_number(cells.at(column), path_.string()); };
    const auto row_step = static_cast<std::int64_t>(number(step_column));
    if (row_step > step || !is_regular(row_step)) break;
    last_step_ = row_step;
    last_time_ = number(time_column);
    for (std::size_t k = 0; k < last_sums_.size(); ++k)
      for (std::size_t i = 0; i < 3; ++i) last_sums_[k][static_cast<Eigen::Index>(i)] = number(sums_column + 3 * k + i);
  }
  if (kept > 0) table_ = CsvTable::resume(path_, kept);
}

void History::look(const Simulation& s) {
  if (is_regular(s.clock.step)) add_row(s);
}

void History::add_last_row(const Simulation& s) { add_row(s); }

void History::add_row(const Simulation& s) {
  if (!table_) table_ = CsvTable::create(path_, column_names(s));
  if (s.clock.step == last_step_) return;
  const double time = s.clock.time();
  const double span = time - last_time_;
  std::vector<Vec3> sums;
  for (const Tool& tool : s.tools) sums.insert(sums.end(), {tool.state.impulse, tool.state.moment});
  last_sums_.resize(sums.size(), Vec3::Zero());

  std::vector<CsvCell> cells{s.clock.step, time};
  for (const Vec3& sum : sums) add_cells(cells, sum);
  cells.insert(cells.end(), s.ledger.value.begin(), s.ledger.value.end());
  cells.insert(cells.end(), {s.ledger.total(), s.ledger.closure_error()});
  for (std::size_t k = 0; k < s.tools.size(); ++k) {
    for (const std::size_t sum : {2 * k, 2 * k + 1})
      add_cells(cells, span > 0.0 ? Vec3((sums[sum] - last_sums_[sum]) / span) : Vec3(Vec3::Zero()));
    if (!moves(s, k)) continue;
    cells.emplace_back(s.tools[k].state.work);
    add_cells(cells, tool_displacement(s, k));
  }
  const CrackCensus cracks = crack_census(s);
  cells.insert(cells.end(),
               {rebound(s).normal, cracks.area, cracks.area_mode_i, cracks.area_mode_ii, cracks.failed_area,
                std::int64_t{count_fragments(s, FragmentLabel::Strict)}, s.totals.inserted_facets});
  table_->add_row(cells);
  last_step_ = s.clock.step;
  last_time_ = time;
  last_sums_ = std::move(sums);
}

}  // namespace knap
