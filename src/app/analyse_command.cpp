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

// Of an option: with its unit, or a bare number in SI.
double positive(const std::string& option, const std::string& text, Quantity quantity) {
  const bool is_bare = text.find_first_not_of("0123456789.eE+-") == std::string::npos;
  const Conversion read = convert_to_si(is_bare ? fmt::format("{} {}", text, si_unit(quantity)) : text, quantity);
  if (!read.problem.empty()) throw InputError(fmt::format("{} \"{}\": {}", option, text, read.problem));
  if (!(read.value > 0.0)) throw InputError(fmt::format("{} \"{}\": must be above 0", option, text));
  return read.value;
}

}  // namespace

ExitCode analyse_command(const AnalyseArguments& arguments) {
  StudyOptions options{.title = title_of(arguments.folders), .broken = arguments.broken};
  if (!arguments.sieve.empty()) options.sieve = positive("--sieve", arguments.sieve, Quantity::Length);
  if (!arguments.normal_speeds.empty()) options.normal_speeds.clear();
  for (const std::string& speed : arguments.normal_speeds)
    options.normal_speeds.push_back(positive("--normal-speeds", speed, Quantity::Speed));
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
