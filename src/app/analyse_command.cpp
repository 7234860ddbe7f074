#include <fmt/format.h>
#include <unistd.h>

#include "app/commands.hpp"
#include "app/terminal.hpp"
#include "config/units.hpp"
#include "study/study_runs.hpp"
#include "study/write_study.hpp"

namespace knap {
namespace {

namespace fs = std::filesystem;

std::string title_of(const std::vector<fs::path>& folders) {
  std::string title;
  for (const fs::path& folder : folders) title += (title.empty() ? "" : " + ") + folder_name(folder);
  return title;
}

}  // namespace

ExitCode analyse_command(const AnalyseArguments& arguments) {
  StudyOptions options{.title = title_of(arguments.folders), .broken = arguments.broken};
  if (!arguments.sieve.empty()) {
    const Conversion sieve = convert_to_si(arguments.sieve, Quantity::Length);
    if (!sieve.problem.empty()) throw InputError("--sieve " + arguments.sieve + ": " + sieve.problem);
    if (!(sieve.value > 0.0)) throw InputError("--sieve " + arguments.sieve + ": must be above 0");
    options.sieve = sieve.value;
  }
  if (!arguments.normal_speeds.empty()) options.normal_speeds = arguments.normal_speeds;
  if (is_terminal(STDOUT_FILENO))
    options.tell = [](const std::string& what) {
      fmt::print("\r\x1b[Kanalysing: {} ...", what);
      std::fflush(stdout);
    };
  const fs::path out = arguments.out.empty() ? arguments.folders.front() : arguments.out;
  const StudyOutcome outcome = write_study(arguments.folders, out / "analysis", out / "report.html", options);
  if (is_terminal(STDOUT_FILENO)) fmt::print("\r\x1b[K");
  for (const std::string& run : outcome.unreadable) fmt::print(stderr, "warning: left out: {}\n", run);
  for (const std::string& verdict : outcome.verdicts) fmt::print("{}\n", verdict);
  fmt::print("{} runs analysed, {} failed, {} not done; {}, plots and tables in {}\n", outcome.runs, outcome.failed,
             outcome.waiting, (out / "report.html").string(), (out / "analysis").string());
  std::fflush(stdout);
  return ExitCode::Ok;
}

}  // namespace knap
