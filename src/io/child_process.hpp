#pragma once
#include <sys/types.h>

#include <chrono>
#include <functional>
#include <optional>
#include <string>

namespace knap {

/// What a child process handed back; `failure` is empty if it succeeded.
struct ChildResult {
  std::string output;
  std::string failure;
};

/// Runs `work` in a forked process and returns its result; an exception, a crash, an exit or the timeout in there
/// becomes `failure`, with the end of what it printed. `work` has a copy of the memory but no other threads: no OpenMP
/// in it.
ChildResult run_in_child(const std::function<std::string()>& work, std::chrono::seconds timeout);

/// Waits for the end of a child of this process; its wait(2) status, or nothing if it still runs at the deadline.
std::optional<int> wait_for_child(pid_t child, std::chrono::steady_clock::time_point deadline);

}  // namespace knap
