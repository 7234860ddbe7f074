#include "io/virtual_display.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>

#include "core/errors.hpp"
#include "io/child_process.hpp"
#include "io/posix_file.hpp"

namespace knap {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int display_descriptor = 3;  // where Xvfb is told to write the number of its display

/// Becomes Xvfb. Between fork and exec only calls that are safe with other threads in the parent.
[[noreturn]] void become_server(int display_pipe, int null_device) {
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  ::setpgid(0, 0);  // a Ctrl-C at the terminal is for us, not for the display
  ::dup2(null_device, STDIN_FILENO);
  ::dup2(null_device, STDOUT_FILENO);
  ::dup2(null_device, STDERR_FILENO);
  if (display_pipe == display_descriptor) {
    ::fcntl(display_pipe, F_SETFD, 0);
  } else {
    ::dup2(display_pipe, display_descriptor);
  }
  ::execlp("Xvfb", "Xvfb", "-displayfd", "3", "-screen", "0", "1280x1024x24", "-nolisten", "tcp", "-noreset", nullptr);
  ::_exit(127);
}

/// The line Xvfb writes once it is up; "" if it ends or the deadline comes before.
std::string read_line(int descriptor, Clock::time_point deadline) {
  std::string line;
  while (line.empty() || line.back() != '\n') {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
    pollfd wait{descriptor, POLLIN, 0};
    if (left <= 0) return "";
    if (::poll(&wait, 1, static_cast<int>(left)) <= 0) continue;
    char c = '\0';
    if (::read(descriptor, &c, 1) == 0) return "";
    line += c;
  }
  line.pop_back();
  return line;
}

}  // namespace

VirtualDisplay::VirtualDisplay(std::chrono::seconds timeout) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw_file_error("pipe", "open");
  const PosixFile out(ends[0]);
  PosixFile in(ends[1]);
  const PosixFile null_device = open_file("/dev/null", O_RDWR);
  server_ = ::fork();
  if (server_ < 0) throw_file_error("process", "fork");
  if (server_ == 0) become_server(in.descriptor(), null_device.descriptor());
  in.close();
  name_ = ":" + read_line(out.descriptor(), Clock::now() + timeout);
  if (name_ == ":") {
    stop();
    throw RuntimeFailure("no virtual display: Xvfb is missing or does not start");
  }
}

VirtualDisplay::~VirtualDisplay() { stop(); }

void VirtualDisplay::stop() {
  ::kill(server_, SIGTERM);  // on this one it removes its socket and lock file
  if (!wait_for_child(server_, Clock::now() + std::chrono::seconds(2))) {
    ::kill(server_, SIGKILL);
    ::waitpid(server_, nullptr, 0);
  }
}

}  // namespace knap
