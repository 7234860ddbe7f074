#include "validation/support/case_run.hpp"

#include <fmt/format.h>

#include "app/prepare_run.hpp"
#include "app/run_results.hpp"
#include "config/load_config.hpp"

namespace knap {

CaseRun run_case(const RunConfig& config, const std::string& name, const CaseRunOptions& options) {
  constexpr bool quiet = true;
  RunLog log(quiet);
  PreparedRun prepared = prepare_run(config, name, log);
  if (options.before_run) options.before_run(prepared.simulation);
  const std::atomic<bool> interrupt = false;
  const StopReason reason = run(prepared.simulation, prepared.limits, options.observers, interrupt);
  if (exit_code(reason) != ExitCode::Ok)
    throw RuntimeFailure(fmt::format("{}: {}", name, failure_message(prepared.simulation, reason)));
  RunOutcome outcome = run_outcome(prepared.simulation, prepared.identity, {.stop_reason = reason});
  return {std::move(prepared.simulation), std::move(outcome)};
}

RunConfig shipped_case(const std::string& name, std::span<const std::string> overrides) {
  return load_config(std::filesystem::path(KNAP_SOURCE_DIR) / "cases" / (name + ".toml"), overrides);
}

}  // namespace knap
