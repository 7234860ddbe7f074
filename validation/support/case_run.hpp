#pragma once
// A run as `knap run` makes it, from a case to its outcome, without files.
#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include "app/run_outcome.hpp"
#include "config/run_config.hpp"

namespace knap {

struct CaseRun {
  Simulation s;  ///< at the end
  RunOutcome outcome;
};

struct CaseRunOptions {
  std::vector<Observer*> observers{};
  std::function<void(Simulation&)> before_run{};  ///< sets what no key of a case sets
};
/// Throws InputError, and RuntimeFailure for a run that does not come to its end.
CaseRun run_case(const RunConfig& config, const std::string& name, const CaseRunOptions& options = {});

/// One of the shipped cases, cases/<name>.toml, with `section.key=value` replaced.
RunConfig shipped_case(const std::string& name, std::span<const std::string> overrides = {});

}  // namespace knap
