#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/interrupt.hpp"
#include "app/prepare_run.hpp"
#include "app/repeated_impacts.hpp"
#include "app/run_results.hpp"
#include "config/load_config.hpp"
#include "core/parallel.hpp"
#include "version.hpp"

namespace knap {
namespace {

namespace fs = std::filesystem;

RunConfig load(const RunArguments& arguments) {
  auto overrides = arguments.overrides;
  if (arguments.threads) overrides.push_back(fmt::format("run.threads={}", *arguments.threads));
  return load_config(arguments.case_file, overrides);
}

std::string case_name(const RunArguments& arguments) { return arguments.case_file.stem().string(); }

FolderUse folder_use(const RunArguments& arguments) {
  if (arguments.resume) return FolderUse::Resume;
  return arguments.overwrite ? FolderUse::Overwrite : FolderUse::New;
}

void tell_how_to_resume(const RunFolder& folder, RunLog& log) {
  log.warn(
      fmt::format("interrupted; to continue, give the same command with --resume and without --overwrite, --out {}",
                  folder.path.string()));
}

}  // namespace

ExitCode run_command(const RunArguments& arguments) {
  const RunConfig config = load(arguments);
  const fs::path out = arguments.out.empty() ? fs::path("out") / case_name(arguments) : arguments.out;
  const PendingRunFolder pending(out, folder_use(arguments), config);
  set_num_threads(config.run.threads);
  catch_interrupts();
  RunLog log(arguments.quiet);
  log.info(fmt::format("Knap {}: {}", version, arguments.case_file.string()));
  PreparedRun run = prepare_run(config, case_name(arguments), log);
  if (interrupt_requested()) {
    log.warn("interrupted before the first step: nothing was written");
    return ExitCode::Interrupted;
  }
  const RunFolder folder = pending.start();
  log.start_file(folder.log());
  const SessionOptions options{
      .folder = folder, .output = config.output, .resume = arguments.resume, .quiet = arguments.quiet};
  try {
    const ExitCode code = config.impact.repeat > 1 ? run_repeated_impacts(std::move(run), config, options, log)
                                                   : exit_code(run_to_results(run, options, log).session.stop_reason);
    if (code == ExitCode::Interrupted) tell_how_to_resume(folder, log);
    return code;
  } catch (const std::exception& error) {
    log.note(fmt::format("ended by an error: {}", error.what()));
    throw;
  }
}

}  // namespace knap
