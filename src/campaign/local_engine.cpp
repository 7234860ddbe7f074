#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <map>
#include <thread>

#include "campaign/engine.hpp"
#include "core/errors.hpp"

namespace knap {
namespace {

constexpr int cannot_execute = 127;

// In the child: from here on only what is safe after a fork.
[[noreturn]] void become(const std::vector<char*>& arguments, int log, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(cannot_execute);  // it died before it could be watched
  ::setpgid(0, 0);                                     // Ctrl-C is for the campaign, which stops its runs itself
  ::dup2(log, STDOUT_FILENO);
  ::dup2(log, STDERR_FILENO);
  ::execv(arguments[0], arguments.data());
  ::_exit(cannot_execute);
}

class LocalEngine : public Engine {
 public:
  explicit LocalEngine(int jobs) : slots_(static_cast<std::size_t>(jobs)) {}
  ~LocalEngine() override {
    stop();
    while (!running_.empty()) wait(std::chrono::milliseconds(1000));
  }
  LocalEngine(const LocalEngine&) = delete;
  LocalEngine& operator=(const LocalEngine&) = delete;

  std::size_t free_slots() const override { return slots_ - running_.size(); }

  void start(const Job& job) override {
    const int log = ::open(job.log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    if (log < 0) throw RuntimeFailure(fmt::format("{}: cannot write: {}", job.log.string(), std::strerror(errno)));
    std::vector<std::string> words = job.command;
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const pid_t parent = ::getpid();
    const pid_t child = ::fork();
    if (child == 0) become(arguments, log, parent);
    const int error = errno;
    ::close(log);
    if (child < 0) throw RuntimeFailure(fmt::format("cannot start a process: {}", std::strerror(error)));
    running_[child] = job.run;
  }

  std::vector<JobEnd> wait(std::chrono::milliseconds patience) override {
    constexpr std::chrono::milliseconds nap(20);
    const auto until = std::chrono::steady_clock::now() + patience;
    std::vector<JobEnd> ended = collect();
    while (ended.empty() && !running_.empty() && std::chrono::steady_clock::now() < until) {
      std::this_thread::sleep_for(nap);
      ended = collect();
    }
    return ended;
  }

  void stop() override {
    for (const auto& [child, run] : running_) ::kill(child, SIGTERM);
  }

 private:
  std::vector<JobEnd> collect() {
    std::vector<JobEnd> ended;
    for (auto it = running_.begin(); it != running_.end();) {
      int status = 0;
      if (::waitpid(it->first, &status, WNOHANG) != it->first) {
        ++it;
        continue;
      }
      ended.push_back({it->second, WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status)});
      it = running_.erase(it);
    }
    return ended;
  }

  std::size_t slots_;
  std::map<pid_t, std::size_t> running_;
};

}  // namespace

std::unique_ptr<Engine> make_local_engine(int jobs) { return std::make_unique<LocalEngine>(jobs); }

}  // namespace knap
