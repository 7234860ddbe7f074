#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "validation/evidence.hpp"

namespace knap {

/// The last result of a problem, as it is kept in result.json.
struct Record {
  std::string commit{};   ///< version of the program
  std::string date{};     ///< of the run, UTC
  double seconds = 0.0;   ///< wall clock
  std::string failure{};  ///< why the problem did not come to its end; empty if it did
  std::vector<Metric> metrics{};
};

/// Whether it came to its end with no metric out of tolerance.
bool passes(const Record& record);

void write_record(const std::filesystem::path& path, const Record& record);
/// Nothing if there is no file. Throws InputError for one that is no record.
std::optional<Record> read_record(const std::filesystem::path& path);

}  // namespace knap
