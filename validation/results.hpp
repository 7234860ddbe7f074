#pragma once
#include <span>
#include <string>

#include "validation/problem.hpp"
#include "validation/record.hpp"

namespace knap {

/// A problem with its last result; without one it has not been run.
struct Result {
  const Problem* problem;
  std::optional<Record> record{};
};

/// The table of all metrics, one row each, as text for a terminal.
std::string console_table(std::span<const Result> results);
/// results.md: machine, totals, the table, and the plots, named relative to the folder of the results.
std::string results_markdown(std::span<const Result> results, const std::string& machine);
/// "3 problems, 14 metrics in tolerance, 1 OUT, 0 failed"
std::string totals(std::span<const Result> results);

/// "12 s", "3.4 min", for the reader.
std::string duration(double seconds);
/// Processor and number of cores of this machine.
std::string machine();

}  // namespace knap
