#include "io/child_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <regex>
#include <thread>

#include "io/posix_file.hpp"

namespace knap {
namespace {

using Clock = std::chrono::steady_clock;

/// A pipe: what is written to `in` can be read from `out`.
struct Pipe {
  PosixFile out;
  PosixFile in;
};

Pipe make_pipe() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw_file_error("pipe", "open");
  return {PosixFile(ends[0]), PosixFile(ends[1])};
}

/// The life of the child. Never returns and runs none of the exit handlers it inherited, whoever calls exit().
[[noreturn]] void live_as_child(const std::function<std::string()>& work, const Pipe& output, const Pipe& messages) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  ::dup2(messages.in.descriptor(), STDOUT_FILENO);
  ::dup2(messages.in.descriptor(), STDERR_FILENO);
  std::atexit([] { ::_exit(1); });
  try {
    write_all(output.in, work(), "pipe");
    ::_exit(0);
  } catch (const std::exception& error) {
    std::fputs(error.what(), stderr);
  }
  ::_exit(1);
}

/// Reads both pipes to their ends. False if the deadline comes first.
bool read_pipes(const Pipe& output, std::string& output_text, const Pipe& messages, std::string& message_text,
                Clock::time_point deadline) {
  std::array<pollfd, 2> waits{pollfd{output.out.descriptor(), POLLIN, 0}, {messages.out.descriptor(), POLLIN, 0}};
  const std::array<std::string*, 2> texts{&output_text, &message_text};
  while (waits[0].fd >= 0 || waits[1].fd >= 0) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0) return false;
    if (::poll(waits.data(), waits.size(), static_cast<int>(left)) <= 0) continue;
    for (std::size_t i = 0; i < waits.size(); ++i) {
      if (waits[i].fd < 0 || waits[i].revents == 0) continue;
      std::array<char, 65536> buffer;
      const ssize_t count = ::read(waits[i].fd, buffer.data(), buffer.size());
      if (count > 0) texts[i]->append(buffer.data(), static_cast<std::size_t>(count));
      if (count == 0) waits[i].fd = -1;
    }
  }
  return true;
}

/// The last words, on one line and without colours.
std::string end_of(std::string text) {
  constexpr std::size_t enough = 600;
  if (text.size() > enough) text.erase(0, text.size() - enough);
  text = std::regex_replace(text, std::regex("\x1b\\[[0-9;]*m"), "");
  text = std::regex_replace(text, std::regex("\\s+"), " ");
  if (text.ends_with(' ')) text.pop_back();
  return text.empty() ? "" : fmt::format(": {}", text);
}

std::string failure_text(const std::optional<int>& status, std::chrono::seconds timeout, std::string messages) {
  const std::string said = end_of(std::move(messages));
  if (!status) return fmt::format("no result after {} s{}", timeout.count(), said);
  if (WIFSIGNALED(*status)) return fmt::format("crashed ({}){}", ::strsignal(WTERMSIG(*status)), said);
  return WEXITSTATUS(*status) == 0 ? "" : fmt::format("failed{}", said);
}

}  // namespace

std::optional<int> wait_for_child(pid_t child, Clock::time_point deadline) {
  for (;;) {
    int status = 0;
    if (::waitpid(child, &status, WNOHANG) == child) return status;
    if (Clock::now() >= deadline) return std::nullopt;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

ChildResult run_in_child(const std::function<std::string()>& work, std::chrono::seconds timeout) {
  const auto deadline = Clock::now() + timeout;
  Pipe output = make_pipe();
  Pipe messages = make_pipe();
  std::fflush(nullptr);
  const pid_t child = ::fork();
  if (child < 0) throw_file_error("process", "fork");
  if (child == 0) live_as_child(work, output, messages);
  output.in.close();
  messages.in.close();
  ChildResult result;
  std::string said;
  const bool ended = read_pipes(output, result.output, messages, said, deadline);
  std::optional<int> status = ended ? wait_for_child(child, deadline) : std::nullopt;
  if (!status) {
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
  }
  result.failure = failure_text(status, timeout, std::move(said));
  return result;
}

}  // namespace knap
