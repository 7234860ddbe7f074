#include "validation/validate.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <deque>
#include <map>

#include "core/errors.hpp"
#include "core/parallel.hpp"
#include "io/file_output.hpp"
#include "validation/results.hpp"
#include "version.hpp"

namespace knap {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

fs::path record_path(const ValidateOptions& options, const Problem& problem) {
  return options.out / problem.name / "result.json";
}

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::vector<const Problem*> chosen(std::span<const Problem> problems, const ValidateOptions& options) {
  std::vector<std::string> names;
  for (const Problem& problem : problems) names.push_back(problem.name);
  for (const std::string& name : options.only)
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      const std::string nearest = nearest_name(name, names);
      throw InputError(fmt::format("--only {}: no problem has that name{}; --list shows all", name,
                                   nearest.empty() ? "" : ", did you mean " + nearest + "?"));
    }
  std::vector<const Problem*> list;
  for (const Problem& problem : problems) {
    const bool named = std::find(options.only.begin(), options.only.end(), problem.name) != options.only.end();
    if (named || (options.only.empty() && (problem.in_short || !options.is_short))) list.push_back(&problem);
  }
  return list;
}

// The one process of a problem: what it prints goes into a log beside its results.
[[noreturn]] void show_and_exit(const Problem& problem, const ValidateOptions& options) {
  const fs::path folder = options.out / problem.name;
  const std::string log = (folder / "log.txt").string();
  const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (file >= 0) dup2(file, STDOUT_FILENO), dup2(file, STDERR_FILENO);
  set_num_threads(1);
  Record record{.commit = version};
  record.date = fmt::format("{:%Y-%m-%d %H:%M}", fmt::gmtime(std::chrono::system_clock::now()));
  const auto start = Clock::now();
  Evidence evidence(problem.name, options.sources / problem.name, folder,
                    {.is_short = options.is_short, .keeps_runs = options.keeps_runs});
  try {
    problem.show(evidence);
    if (evidence.metrics().empty()) record.failure = "it compared nothing";
  } catch (const std::exception& error) {
    record.failure = error.what();
  }
  record.metrics = evidence.metrics();
  record.seconds = seconds_since(start);
  int code = 0;
  try {
    write_record(folder / "result.json", record);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    code = 1;
  }
  std::fflush(nullptr);
  _exit(code);
}

/// The problems under way and still to come.
class Queue {
 public:
  Queue(std::vector<const Problem*> problems, const ValidateOptions& options)
      : options_(options), waiting_(problems.begin(), problems.end()) {
    for (const Problem* problem : problems) {
      const auto last = read_record(record_path(options, *problem));
      expected_[problem] = last ? last->seconds : 10.0;
    }
    // The longest first, so that none is left alone at the end.
    std::stable_sort(waiting_.begin(), waiting_.end(),
                     [this](const Problem* a, const Problem* b) { return expected_[a] > expected_[b]; });
  }

  void run() {
    while (!waiting_.empty() || !running_.empty()) {
      while (!waiting_.empty() && running_.size() < static_cast<std::size_t>(options_.jobs)) start_next();
      wait_for_one();
    }
  }

 private:
  struct Job {
    const Problem* problem;
    Clock::time_point start;
  };

  void start_next() {
    const Problem* problem = waiting_.front();
    waiting_.pop_front();
    fs::create_directories(options_.out / problem->name);
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child < 0) throw RuntimeFailure(fmt::format("cannot start a process: {}", std::strerror(errno)));
    if (child == 0) show_and_exit(*problem, options_);
    running_[child] = {problem, Clock::now()};
  }

  void wait_for_one() {
    int status = 0;
    const pid_t child = waitpid(-1, &status, 0);
    const auto found = running_.find(child);
    if (found == running_.end()) return;
    const Job job = found->second;
    running_.erase(found);
    std::optional<Record> record;
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) record = read_record(record_path(options_, *job.problem));
    if (!record) {  // it crashed, or could not write: then the record there, if any, is an earlier one
      record = Record{.commit = version, .seconds = seconds_since(job.start)};
      record->failure = WIFSIGNALED(status) ? fmt::format("ended by signal {}; see its log.txt", WTERMSIG(status))
                                            : "left no result; see its log.txt";
      write_record(record_path(options_, *job.problem), *record);
    }
    tell(job, *record);
  }

  void tell(const Job& job, const Record& record) {
    double left = 0.0;
    for (const Problem* problem : waiting_) left += expected_[problem];
    for (const auto& [child, other] : running_)
      left += std::max(0.0, expected_[other.problem] - seconds_since(other.start));
    const std::size_t count = waiting_.size() + running_.size();
    const std::string outlook =
        count == 0 ? "" : fmt::format(" ({} left, about {})", count, duration(left / options_.jobs));
    fmt::print("{:24} {} {}{}\n", job.problem->name, passes(record) ? "passes" : "FAILS", duration(record.seconds),
               outlook);
    std::fflush(stdout);
  }

  const ValidateOptions& options_;
  std::deque<const Problem*> waiting_;
  std::map<pid_t, Job> running_;
  std::map<const Problem*, double> expected_;  // [s]
};

std::vector<Result> results_of(std::span<const Problem* const> problems, const ValidateOptions& options) {
  std::vector<Result> results;
  for (const Problem* problem : problems) results.push_back({problem, read_record(record_path(options, *problem))});
  return results;
}

}  // namespace

int validate(std::span<const Problem> problems, const ValidateOptions& options) {
  const std::vector<const Problem*> list = chosen(problems, options);
  fs::create_directories(options.out);
  Queue(list, options).run();
  const std::vector<Result> now = results_of(list, options);
  std::vector<const Problem*> all;
  for (const Problem& problem : problems) all.push_back(&problem);
  const std::vector<Result> kept = results_of(all, options);
  write_text_atomically(options.out / "results.md", results_markdown(kept, machine()));
  fmt::print("\n{}\n{}.\n{}\n", console_table(now), totals(now), (options.out / "results.md").string());
  return std::all_of(now.begin(), now.end(), [](const Result& result) { return passes(*result.record); }) ? 0 : 1;
}

}  // namespace knap
