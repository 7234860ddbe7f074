#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/run_sanity.hpp"
#include "config/load_config.hpp"
#include "core/parallel.hpp"

namespace knap {

ExitCode check_command(const CheckArguments& arguments) {
  const RunConfig config = load_config(arguments.case_file, arguments.overrides);
  set_num_threads(config.run.threads);
  const SanityCard card = expected_card(config);
  fmt::print("{}", format_sanity_card(card));
  std::fflush(stdout);
  const auto reasons = refusals(card);
  for (const std::string& reason : reasons)
    fmt::print(stderr, "{}: {}\n", config.particles[0].fracture.allow_unresolved ? "warning" : "error", reason);
  if (!reasons.empty() && !config.particles[0].fracture.allow_unresolved) return ExitCode::BadInput;
  fmt::print("{}: the case is valid\n", arguments.case_file.string());
  return ExitCode::Ok;
}

}  // namespace knap
