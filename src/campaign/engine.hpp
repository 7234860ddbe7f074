#pragma once
// What runs the runs of a campaign. A job is a command; how and where it is run is the engine's.
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace knap {

struct Job {
  std::size_t run = 0;               ///< which run of the campaign
  std::vector<std::string> command;  ///< program and arguments
  std::filesystem::path log;         ///< where its output goes
};

struct JobEnd {
  std::size_t run = 0;
  int exit_code = 0;  ///< 128 + n where signal n ended it
};

class Engine {
 public:
  virtual ~Engine() = default;
  /// How many more jobs it takes now.
  virtual std::size_t free_slots() const = 0;
  /// Throws RuntimeFailure if the job cannot be started.
  virtual void start(const Job& job) = 0;
  /// The jobs that have ended since the last call; waits for one up to `patience`.
  virtual std::vector<JobEnd> wait(std::chrono::milliseconds patience) = 0;
  /// Asks all that run to stop; they still end one by one.
  virtual void stop() = 0;
};

/// Processes on this machine, `jobs` at a time. They are told to stop when this process dies.
std::unique_ptr<Engine> make_local_engine(int jobs);

}  // namespace knap
