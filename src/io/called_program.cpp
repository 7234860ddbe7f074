#include "io/called_program.hpp"

#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>

#include "io/child_process.hpp"
#include "io/posix_file.hpp"

namespace knap {
namespace {

constexpr int no_such_program = 127;

// What a program says goes into memory: no pipe that has to be emptied while it runs.
PosixFile memory_file(const char* name) {
  PosixFile file(::memfd_create(name, MFD_CLOEXEC));
  if (!file.is_open()) throw_file_error(name, "open");
  return file;
}

std::string all_of(const PosixFile& file) {
  std::string text;
  std::array<char, 65536> buffer;
  ::lseek(file.descriptor(), 0, SEEK_SET);
  for (ssize_t count = 0; (count = ::read(file.descriptor(), buffer.data(), buffer.size())) > 0;)
    text.append(buffer.data(), static_cast<std::size_t>(count));
  return text;
}

}  // namespace

ProgramEnd call_program(std::vector<std::string> words, std::chrono::seconds timeout) {
  const PosixFile out = memory_file("stdout"), err = memory_file("stderr");
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const pid_t child = ::fork();
  if (child < 0) throw_file_error("process", "fork");
  if (child == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::setpgid(0, 0);  // Ctrl-C is for the caller
    ::dup2(out.descriptor(), STDOUT_FILENO);
    ::dup2(err.descriptor(), STDERR_FILENO);
    ::execvp(arguments[0], arguments.data());
    ::_exit(no_such_program);
  }
  std::optional<int> status = wait_for_child(child, std::chrono::steady_clock::now() + timeout);
  if (!status) {
    ::kill(child, SIGKILL);
    int killed = 0;
    ::waitpid(child, &killed, 0);
    status = killed;
  }
  const int code = WIFSIGNALED(*status) ? 128 + WTERMSIG(*status) : WEXITSTATUS(*status);
  return {code, all_of(out), all_of(err)};
}

}  // namespace knap
