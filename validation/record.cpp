#include "validation/record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/errors.hpp"
#include "io/csv_line.hpp"
#include "io/file_output.hpp"

namespace knap {
namespace {

using Json = nlohmann::ordered_json;

// JSON knows no infinity and no nan.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(fmt::format("{}", value)); }
double number(const Json& json) { return json.is_string() ? std::stod(json.get<std::string>()) : json.get<double>(); }

Json json_of(const Metric& metric) {
  return {{"name", metric.name},       {"value", number(metric.value)}, {"reference", number(metric.reference)},
          {"low", number(metric.low)}, {"high", number(metric.high)},   {"tolerance", metric.tolerance},
          {"why", metric.why}};
}

Metric metric_of(const Json& json) {
  return {json.at("name"),        number(json.at("value")), number(json.at("reference")),
          number(json.at("low")), number(json.at("high")),  json.at("tolerance"),
          json.at("why")};
}

}  // namespace

bool passes(const Record& record) {
  return record.failure.empty() && std::none_of(record.metrics.begin(), record.metrics.end(),
                                                [](const Metric& metric) { return judge(metric) == Judgement::Out; });
}

void write_record(const std::filesystem::path& path, const Record& record) {
  Json json{{"commit", record.commit}, {"date", record.date}, {"seconds", record.seconds}, {"failure", record.failure}};
  json["metrics"] = Json::array();
  for (const Metric& metric : record.metrics) json["metrics"].push_back(json_of(metric));
  write_text_atomically(path, json.dump(1) + "\n");
}

std::optional<Record> read_record(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) return std::nullopt;
  try {
    const Json json = Json::parse(read_text(path));
    Record record{json.at("commit"), json.at("date"), json.at("seconds"), json.at("failure")};
    for (const Json& metric : json.at("metrics")) record.metrics.push_back(metric_of(metric));
    return record;
  } catch (const std::exception& error) {
    throw InputError(
        fmt::format("{}: not the record of a validation problem ({}); remove it", path.string(), error.what()));
  }
}

}  // namespace knap
