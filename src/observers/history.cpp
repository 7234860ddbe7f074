#include "observers/history.hpp"

#include <fmt/format.h>

#include "io/csv_line.hpp"
#include "observers/fragment_census.hpp"

namespace knap {
namespace {

constexpr std::size_t step_column = 0;
constexpr std::size_t time_column = 1;
constexpr std::size_t impulse_column = 2;  // and the two after it

std::vector<std::string> column_names() {
  std::vector<std::string> names{"step", "time [s]", "wall_impulse_x [N s]", "wall_impulse_y [N s]",
                                 "wall_impulse_z [N s]"};
  for (std::size_t term = 0; term < num_energy_terms; ++term)
    names.push_back(fmt::format("{} [J]", name(static_cast<EnergyTerm>(term))));
  for (const char* other : {"energy_sum [J]", "closure_error [-]", "wall_force_x [N]", "wall_force_y [N]",
                            "wall_force_z [N]", "restitution [-]", "cracked_area [m2]", "cracked_area_mode_i [m2]",
                            "cracked_area_mode_ii [m2]", "failed_area [m2]", "fragments [-]", "inserted_facets [-]"})
    names.emplace_back(other);
  return names;
}

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

void History::resume(std::int64_t step) {
  const auto rows = complete_rows(path_);
  std::size_t kept = 0;
  for (; kept < rows.size(); ++kept) {
    const auto cells = csv_cells(rows[kept]);
    const auto number = [&](std::size_t column) { return csv_number(cells.at(column), path_.string()); };
    const auto row_step = static_cast<std::int64_t>(number(step_column));
    if (row_step > step || !is_regular(row_step)) break;
    last_step_ = row_step;
    last_time_ = number(time_column);
    for (std::size_t k = 0; k < 3; ++k) last_impulse_[static_cast<Eigen::Index>(k)] = number(impulse_column + k);
  }
  if (kept > 0) table_ = CsvTable::resume(path_, kept);
}

void History::look(const Simulation& s) {
  if (is_regular(s.clock.step)) add_row(s);
}

void History::add_last_row(const Simulation& s) { add_row(s); }

void History::add_row(const Simulation& s) {
  if (!table_) table_ = CsvTable::create(path_, column_names());
  if (s.clock.step == last_step_) return;
  const double time = s.clock.time();
  const Vec3 impulse = s.tools.empty() ? Vec3(Vec3::Zero()) : s.tools.front().state.impulse;
  const Vec3 force = time > last_time_ ? Vec3((impulse - last_impulse_) / (time - last_time_)) : Vec3::Zero();
  const CrackCensus cracks = crack_census(s);

  std::vector<CsvCell> cells{s.clock.step, time, impulse.x(), impulse.y(), impulse.z()};
  cells.insert(cells.end(), s.ledger.value.begin(), s.ledger.value.end());
  cells.insert(cells.end(),
               {s.ledger.total(), s.ledger.closure_error(), force.x(), force.y(), force.z(), rebound(s).normal,
                cracks.area, cracks.area_mode_i, cracks.area_mode_ii, cracks.failed_area,
                std::int64_t{count_fragments(s, FragmentLabel::Strict)}, s.totals.inserted_facets});
  table_->add_row(cells);
  last_step_ = s.clock.step;
  last_time_ = time;
  last_impulse_ = impulse;
}

}  // namespace knap
