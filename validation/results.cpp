#include "validation/results.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <set>
#include <thread>

namespace knap {
namespace {

std::string number(double value) { return std::isfinite(value) ? fmt::format("{:.4g}", value) : "-"; }

std::string word(Judgement judgement) {
  switch (judgement) {
    case Judgement::Passes:
      return "passes";
    case Judgement::Out:
      return "OUT";
    case Judgement::Told:
      break;
  }
  return "told";
}

// A cell of a Markdown table.
std::string cell(std::string text) {
  for (std::size_t i = 0; (i = text.find('|', i)) != std::string::npos; i += 2) text.insert(i, 1, '\\');
  for (char& c : text)
    if (c == '\n') c = ' ';
  return text;
}

void add_markdown_rows(std::string& text, const Result& result) {
  const Problem& problem = *result.problem;
  if (!result.record) return;
  std::string head = fmt::format("{} | {}", problem.name, cell(problem.reference));
  std::string time = duration(result.record->seconds);
  for (const Metric& metric : result.record->metrics) {
    const std::string tolerance =
        metric.why.empty() ? metric.tolerance
                           : fmt::format("{}{}{}", metric.tolerance, metric.tolerance.empty() ? "" : ": ", metric.why);
    const std::string said = word(judge(metric));
    text += fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", head, cell(metric.name), number(metric.reference),
                        cell(tolerance), number(metric.value), said == "OUT" ? "**OUT**" : said, time);
    head = " | ";
    time.clear();
  }
  if (!result.record->failure.empty())
    text += fmt::format("| {} | | | | | **failed**: {} | {} |\n", head, cell(result.record->failure), time);
}

void add_pictures(std::string& text, std::span<const Result> results) {
  text += "\n## Plots\n";
  for (const Result& result : results)
    if (result.record && result.record->failure.empty())
      text += fmt::format("\n### {0}\n{1}\n\n![{0}]({0}/{0}.png)\n", result.problem->name, result.problem->reference);
}

}  // namespace

std::string duration(double seconds) {
  return seconds < 99.5 ? fmt::format("{:.0f} s", seconds) : fmt::format("{:.1f} min", seconds / 60.0);
}

std::string console_table(std::span<const Result> results) {
  std::string text = fmt::format("{:24} {:44} {:>10} {:>10} {:18} {:7} {:>6}\n", "PROBLEM", "METRIC", "VALUE",
                                 "REFERENCE", "TOLERANCE", "VERDICT", "TIME");
  for (const Result& result : results) {
    if (!result.record) continue;
    std::string name = result.problem->name, time = duration(result.record->seconds);
    for (const Metric& metric : result.record->metrics) {
      text += fmt::format("{:24} {:44} {:>10} {:>10} {:18} {:7} {:>6}\n", name, metric.name, number(metric.value),
                          number(metric.reference), metric.tolerance, word(judge(metric)), time);
      name.clear(), time.clear();
    }
    if (!result.record->failure.empty())
      text += fmt::format("{:24} failed: {} {}\n", name, result.record->failure, time);
  }
  return text;
}

std::string totals(std::span<const Result> results) {
  int run = 0, passed = 0, out = 0, told = 0, failed = 0;
  for (const Result& result : results) {
    if (!result.record) continue;
    ++run;
    failed += !result.record->failure.empty();
    for (const Metric& metric : result.record->metrics) {
      const Judgement said = judge(metric);
      ++(said == Judgement::Passes ? passed : said == Judgement::Out ? out : told);
    }
  }
  return fmt::format(
      "{} of {} problems run: {} metrics in tolerance, {} OUT, {} told without a verdict; {} problems failed", run,
      results.size(), passed, out, told, failed);
}

std::string results_markdown(std::span<const Result> results, const std::string& machine) {
  std::set<std::string> commits;
  double seconds = 0.0;
  std::string first, last;
  for (const Result& result : results) {
    if (!result.record) continue;
    commits.insert(result.record->commit);
    seconds += result.record->seconds;
    if (first.empty() || result.record->date < first) first = result.record->date;
    last = std::max(last, result.record->date);
  }
  std::string text =
      "# Results of the validation\n\nWritten by `./dev validate`; what the problems are: README.md.\n\n";
  text += fmt::format("{}. Machine: {}. {} to {} (UTC), {} of one core. Version:", totals(results), machine, first,
                      last, duration(seconds));
  for (const std::string& commit : commits) text += " " + commit;
  text += ".\n\n| problem | reference and source | metric | reference | tolerance and why | value | verdict | time |\n";
  text += "|---|---|---|---|---|---|---|---|\n";
  for (const Result& result : results) add_markdown_rows(text, result);
  add_pictures(text, results);
  return text;
}

std::string machine() {
  std::ifstream file("/proc/cpuinfo");
  std::string line, model = "unknown processor";
  while (std::getline(file, line))
    if (line.starts_with("model name") && line.find(": ") != std::string::npos) {
      model = line.substr(line.find(": ") + 2);
      break;
    }
  return fmt::format("{}, {} cores", model, std::thread::hardware_concurrency());
}

}  // namespace knap
