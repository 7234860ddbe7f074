#pragma once
// Runs the real program as a user would.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/temporary_folder.hpp"

namespace knap {

/// A program that runs.
struct Started {
  pid_t pid = -1;
  std::filesystem::path out, err;
};

struct Ended {
  int code = -1;  ///< exit code, or 128 + signal
  std::string out, err;
};

/// A test with an empty folder, which is the program's working directory.
class ProgramTest : public TemporaryFolder {
 protected:
  Started start(const std::vector<std::string>& arguments) const {
    static int count = 0;
    const std::string number = std::to_string(++count);
    Started started{-1, folder / (".out" + number), folder / (".err" + number)};
    started.pid = ::fork();
    if (started.pid == 0) execute(arguments, started);
    return started;
  }
  Ended wait(const Started& started) const {
    int status = 0;
    ::waitpid(started.pid, &status, 0);
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return {code, content(started.out), content(started.err)};
  }
  Ended run(const std::vector<std::string>& arguments) const { return wait(start(arguments)); }

  /// Waits until the file is there, or the program has ended without it.
  bool wait_for(const std::filesystem::path& file, const Started& started) const {
    for (int i = 0; i < 12000; ++i) {
      if (std::filesystem::exists(file)) return true;
      if (::kill(started.pid, 0) != 0) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder / name) << text; }
  nlohmann::json report(const std::string& run_folder) const {
    return nlohmann::json::parse(content(folder / run_folder / "report.json"));
  }

 private:
  [[noreturn]] void execute(const std::vector<std::string>& arguments, const Started& started) const {
    const auto redirect = [](const std::filesystem::path& file, int descriptor) {
      ::dup2(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644), descriptor);
    };
    redirect(started.out, STDOUT_FILENO);
    redirect(started.err, STDERR_FILENO);
    if (::chdir(folder.c_str()) != 0) ::_exit(126);
    std::vector<char*> pointers{const_cast<char*>(KNAP_PROGRAM)};
    for (const std::string& argument : arguments) pointers.push_back(const_cast<char*>(argument.c_str()));
    pointers.push_back(nullptr);
    ::execv(KNAP_PROGRAM, pointers.data());
    ::_exit(127);
  }
};

/// A small sphere, too coarse to mean anything, that breaks within a second or two.
inline constexpr const char* breaking_case = R"(
[particle]
diameter = "2 mm"
[mesh]
element_size = "0.3 mm"
contact_element_size = "0.18 mm"
contact_extent = "0.4 mm"
[material]
preset = "zeolite_4ak"
[fracture]
allow_unresolved = true
[impact]
speed = "25 m/s"
angle = "70 deg"
[run]
end_time = "16 us"
[output]
frames = 4
picture = false
)";

/// A sphere that cannot break, as coarse, done within a second.
inline constexpr const char* elastic_case = R"(
[particle]
diameter = "2 mm"
[mesh]
element_size = "0.35 mm"
[material]
young_modulus = "1 GPa"
poisson_ratio = 0.25
density = "1000 kg/m3"
[fracture]
insertion = "none"
allow_unresolved = true
[impact]
speed = "10 m/s"
angle = "60 deg"
[output]
frames = 0
picture = false
)";

}  // namespace knap
