#include "validation/evidence.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace knap {
namespace {

std::string percent(double share) { return fmt::format("{:.3g} %", 100.0 * share); }

}  // namespace

Judgement judge(const Metric& metric) {
  if (std::isinf(metric.low) && std::isinf(metric.high)) return Judgement::Told;
  return metric.value >= metric.low && metric.value <= metric.high ? Judgement::Passes : Judgement::Out;  // nan is out
}

void Evidence::relative(const std::string& name, double value, double reference, double tolerance,
                        const std::string& why) {
  const double margin = tolerance * std::abs(reference);
  metrics_.push_back({name, value, reference, reference - margin, reference + margin, percent(tolerance), why});
}

void Evidence::absolute(const std::string& name, double value, double reference, double tolerance,
                        const std::string& why) {
  metrics_.push_back(
      {name, value, reference, reference - tolerance, reference + tolerance, fmt::format("+- {:.3g}", tolerance), why});
}

void Evidence::between(const std::string& name, double value, double low, double high, const std::string& why) {
  metrics_.push_back({.name = name,
                      .value = value,
                      .low = low,
                      .high = high,
                      .tolerance = fmt::format("{:.4g} to {:.4g}", low, high),
                      .why = why});
}

void Evidence::at_most(const std::string& name, double value, double bound, const std::string& why) {
  metrics_.push_back(
      {.name = name, .value = value, .high = bound, .tolerance = fmt::format("at most {:.3g}", bound), .why = why});
}

void Evidence::at_least(const std::string& name, double value, double bound, const std::string& why) {
  metrics_.push_back(
      {.name = name, .value = value, .low = bound, .tolerance = fmt::format("at least {:.4g}", bound), .why = why});
}

void Evidence::tell(const std::string& name, double value, const std::string& why) {
  metrics_.push_back({.name = name, .value = value, .why = why});
}

void Evidence::curve(const std::vector<Column>& columns, const std::string& file) const {
  std::vector<std::string> names;
  for (const Column& column : columns) {
    if (column.values.size() != columns.front().values.size()) throw std::invalid_argument("curve: unequal lengths");
    names.push_back(column.name);
  }
  CsvTable table = CsvTable::create(folder_ / file, names);
  for (std::size_t row = 0; row < columns.front().values.size(); ++row) {
    std::vector<CsvCell> cells;
    for (const Column& column : columns) cells.emplace_back(column.values[row]);
    table.add_row(cells);
  }
}

void Evidence::plot(const PlotInput& input) const { draw_plot(folder_ / (problem_ + ".png"), input); }

}  // namespace knap
