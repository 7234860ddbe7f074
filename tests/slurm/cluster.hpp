#pragma once
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace knap {

/// Slurm with two nodes of two processors each, and arrays of at most five tasks (tests/slurm/cluster). It lives as
/// long as this object, or this process.
class Cluster {
 public:
  /// Why there can be none on this machine; "" = there can.
  static std::string obstacle() {
    if (::geteuid() != 0) return "a Slurm cluster needs root";
    for (const char* program : {"munged", "slurmctld", "slurmd", "squeue"})
      if (call(std::string("command -v ") + program) != 0) return std::string(program) + " is not installed";
    if (call("unshare --pid --fork --mount-proc true") != 0) return "no PID namespaces here";
    return "";
  }

  explicit Cluster(std::filesystem::path folder) : folder_(std::move(folder)) {
    const std::string path = folder_.string();
    holder_ = ::fork();
    if (holder_ == 0) {
      ::prctl(PR_SET_PDEATHSIG, SIGKILL);
      const int silence = ::open("/dev/null", O_RDWR);
      for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(silence, descriptor);
      ::execl(KNAP_SLURM_CLUSTER, KNAP_SLURM_CLUSTER, "hold", path.c_str(), nullptr);
      ::_exit(127);
    }
    is_up_ = tell("await") == 0;
    ::setenv("SLURM_CONF", (path + "/slurm.conf").c_str(), 1);
  }
  ~Cluster() {
    ::kill(holder_, SIGKILL);
    ::waitpid(holder_, nullptr, 0);
    ::unsetenv("SLURM_CONF");
  }
  Cluster(const Cluster&) = delete;
  Cluster& operator=(const Cluster&) = delete;

  bool is_up() const { return is_up_; }
  /// "n1" or "n2".
  void kill_node(const std::string& node) const { tell("kill", node); }
  void pause_controller() const { tell("pause"); }
  void revive_controller() const { tell("revive", "controller"); }

  static int call(const std::string& command) {
    return std::system(("PATH=$PATH:/usr/sbin:/sbin; " + command + " >/dev/null 2>&1").c_str());
  }

 private:
  int tell(const std::string& verb, const std::string& what = "") const {
    return call(KNAP_SLURM_CLUSTER " " + verb + " '" + folder_.string() + "' " + what);
  }

  std::filesystem::path folder_;
  pid_t holder_ = -1;
  bool is_up_ = false;
};

}  // namespace knap
