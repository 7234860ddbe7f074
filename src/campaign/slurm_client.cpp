#include "campaign/slurm_client.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>
#include <string_view>

#include "core/errors.hpp"
#include "io/called_program.hpp"
#include "io/csv_line.hpp"

namespace knap {
namespace {

constexpr int no_such_program = 127;
// The commands have time limits of their own, of seconds; this is for one that hangs.
constexpr std::chrono::seconds longest_call(180);
// Names may hold anything and come last.
constexpr const char* format = "--format=%F|%K|%T|%r|%j";

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return std::string(trimmed(text));
}

std::optional<int> integer(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

SlurmAnswer ask_slurm(const std::vector<std::string>& words) {
  const ProgramEnd end = call_program(words, longest_call);
  if (end.exit_code == 0) return {end.out, ""};
  if (end.exit_code == no_such_program)
    return {"", fmt::format("{}: there is no such program in PATH: is this a machine of a Slurm cluster?", words[0])};
  const std::string said = one_line(end.err);
  return {"", said.empty() ? fmt::format("{}: ended with code {}", words[0], end.exit_code) : said};
}

// A state that is not known here is one of a task that lives: nothing is run twice by mistake.
bool QueuedTask::is_over() const {
  constexpr std::array<std::string_view, 10> over{"BOOT_FAIL", "CANCELLED", "COMPLETED",     "DEADLINE",  "FAILED",
                                                  "NODE_FAIL", "REVOKED",   "OUT_OF_MEMORY", "PREEMPTED", "TIMEOUT"};
  return std::find(over.begin(), over.end(), state) != over.end();
}

std::vector<QueuedTask> queued_tasks_of_text(const std::string& text) {
  constexpr std::size_t before_name = 4;
  std::vector<QueuedTask> tasks;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> cells;
    std::size_t begin = 0;
    for (std::size_t bar = 0; cells.size() < before_name && (bar = line.find('|', begin)) != std::string::npos;
         begin = bar + 1)
      cells.push_back(line.substr(begin, bar - begin));
    if (cells.size() < before_name) continue;
    if (const auto index = integer(cells[1]))  // "N/A" for a job that is no array
      tasks.push_back({cells[0], *index, cells[2], cells[3], line.substr(begin)});
  }
  return tasks;
}

std::optional<std::vector<QueuedTask>> queued_tasks(std::string& failure) {
  const SlurmAnswer answer =
      ask_slurm({"squeue", "--noheader", "--array", "--states=all", fmt::format("--user={}", ::getuid()), format});
  failure = answer.failure;
  if (!failure.empty()) return std::nullopt;
  return queued_tasks_of_text(answer.text);
}

int max_array_size_of_text(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("MaxArraySize"))
      return integer(trimmed(std::string_view(line).substr(line.find('=') + 1))).value_or(0);
  return 0;
}

int max_array_size() {
  const SlurmAnswer answer = ask_slurm({"scontrol", "show", "config"});
  if (!answer.failure.empty()) throw RuntimeFailure(answer.failure);
  const int size = max_array_size_of_text(answer.text);
  if (size < 1) throw RuntimeFailure("scontrol show config: this Slurm takes no array jobs (MaxArraySize)");
  return size;
}

}  // namespace knap
