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
  std::string name;                  ///< the run's, the same in every session
  std::vector<std::string> command;  ///< program and arguments
  std::filesystem::path log;         ///< where its output goes
};

struct JobEnd {
  std::size_t run = 0;
  int exit_code = 0;     ///< 128 + n where signal n ended it
  bool is_lost = false;  ///< it did not end by itself: how far it came is not known, nor is its exit code
  std::string reason{};  ///< what the engine knows of why; "" = nothing
};

/// What a user who waits wants to know.
struct EngineStatus {
  std::size_t queued = 0;  ///< jobs that were started and wait for their turn
  std::string remark{};    ///< what keeps them; "" = nothing
};

class Engine {
 public:
  virtual ~Engine() = default;
  /// How many more jobs it takes now.
  virtual std::size_t free_slots() const = 0;
  /// A job that an earlier session started and that is still under way is taken over instead. Throws RuntimeFailure if
  /// the job cannot be started.
  virtual void start(const Job& job) = 0;
  /// The jobs that have ended since the last call; waits for one up to `patience`.
  virtual std::vector<JobEnd> wait(std::chrono::milliseconds patience) = 0;
  /// Asks all that run to stop; they still end one by one.
  virtual void stop() = 0;
  virtual EngineStatus status() const { return {}; }
};

/// Processes on this machine, `jobs` at a time. They are told to stop when this process dies.
std::unique_ptr<Engine> make_local_engine(int jobs);

}  // namespace knap
