#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "validation/problem.hpp"

namespace knap {

struct ValidateOptions {
  bool is_short = false;            ///< leave out what takes long
  bool keeps_runs = false;          ///< studies go on from the runs of an earlier session
  std::vector<std::string> only{};  ///< names of problems; none = all
  std::filesystem::path sources{};  ///< the folder validation/
  std::filesystem::path out{};      ///< of result.json, curve and plot of each problem, and of results.md
  int jobs = 1;                     ///< problems at a time, each with one thread
};

/// Runs the problems, each in a process of its own; prints the table and writes results.md with the last results of all
/// that are in `out`. Returns 0 if everything run lies in its tolerance, 1 if not. Throws InputError for an unknown
/// name, RuntimeFailure.
int validate(std::span<const Problem> problems, const ValidateOptions& options);

}  // namespace knap
