#include "campaign/results_table.hpp"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "io/csv_line.hpp"
#include "io/file_output.hpp"

namespace knap {
namespace {

using Json = nlohmann::ordered_json;
using Cells = std::vector<std::pair<std::string, std::string>>;

std::string cell_of(const Value& value) {
  struct Writer {
    std::string operator()(std::monostate) const { return ""; }
    std::string operator()(double x) const { return fmt::format("{}", x); }
    std::string operator()(std::int64_t x) const { return std::to_string(x); }
    std::string operator()(bool x) const { return x ? "1" : "0"; }
    std::string operator()(const std::string& x) const { return csv_quoted(x); }
    std::string operator()(const Vec3& x) const { return fmt::format("{} {} {}", x[0], x[1], x[2]); }
  };
  return std::visit(Writer{}, value);
}

void flatten(const Json& json, const std::string& way, Cells& cells);

// Vectors by their components, lists of things by their names.
void flatten_list(const Json& list, const std::string& way, Cells& cells) {
  constexpr std::array axes{"x", "y", "z"};
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list[i].is_object())
      flatten(list[i], fmt::format("{}.{}", way, list[i].value("name", std::to_string(i))), cells);
    else if (list.size() == axes.size())
      flatten(list[i], fmt::format("{}.{}", way, axes[i]), cells);
  }
}

void flatten(const Json& json, const std::string& way, Cells& cells) {
  if (json.is_object()) {
    for (const auto& [key, value] : json.items())
      if (way.empty() ? key != "units" && key != "status" && key != "case" : key != "name" && key != "phases")
        flatten(value, way.empty() ? key : way + "." + key, cells);
  } else if (json.is_array()) {
    flatten_list(json, way, cells);
  } else if (json.is_boolean()) {
    cells.emplace_back(way, json.get<bool>() ? "1" : "0");
  } else {
    cells.emplace_back(way, json.is_null()             ? ""
                            : json.is_number_integer() ? fmt::format("{}", json.get<std::int64_t>())
                            : json.is_number()         ? fmt::format("{}", json.get<double>())
                                                       : csv_quoted(json.get<std::string>()));
  }
}

Cells numbers_of(const std::filesystem::path& report) {
  std::ifstream file(report);
  const Json json = Json::parse(file, nullptr, false);
  Cells cells;
  if (!json.is_discarded()) flatten(json, "", cells);
  return cells;
}

// All columns of the rows, in the order in which they come first.
std::vector<std::string> columns_of(const std::vector<Cells>& rows) {
  std::vector<std::string> columns;
  std::map<std::string, bool> seen;
  for (const Cells& row : rows)
    for (const auto& [column, cell] : row)
      if (!std::exchange(seen[column], true)) columns.push_back(column);
  return columns;
}

void add_cells(std::string& line, const std::vector<std::string>& columns, const Cells& cells) {
  const std::map<std::string, std::string> by_column(cells.begin(), cells.end());
  for (const std::string& column : columns) {
    const auto found = by_column.find(column);
    line += "," + (found == by_column.end() ? "" : found->second);
  }
}

}  // namespace

ResultsTable::ResultsTable(CampaignFolder folder, const CampaignConfig& campaign, std::vector<CampaignRun> runs)
    : folder_(std::move(folder)), runs_(std::move(runs)), status_(runs_.size()), numbers_(runs_.size()) {
  const std::vector<std::string> keys = campaign_keys(campaign);
  for (const CampaignRun& run : runs_) {
    Cells cells;
    for (std::size_t k = 0; k < keys.size(); ++k)
      cells.emplace_back(column_of(keys[k]), cell_of(value_of(keys[k], run.values[k])));
    parameters_.push_back(std::move(cells));
  }
}

void ResultsTable::set(std::size_t run, const RunStatus& status) {
  status_[run] = status;
  numbers_[run] = status.state == RunState::Done ? numbers_of(folder_.run(runs_[run]) / "report.json") : Cells();
}

void ResultsTable::write() const {
  const std::vector<std::string> parameters = columns_of(parameters_), numbers = columns_of(numbers_);
  std::string text = "run,state,reason";
  for (const auto* columns : {&parameters, &numbers})
    for (const std::string& column : *columns) text += "," + csv_quoted(column);
  text += "\n";
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    text += fmt::format("{},{},{}", csv_quoted(runs_[i].name), name(status_[i].state), csv_quoted(status_[i].reason));
    add_cells(text, parameters, parameters_[i]);
    add_cells(text, numbers, numbers_[i]);
    text += "\n";
  }
  write_text_atomically(folder_.results(), text);
}

}  // namespace knap
