#pragma once
#include <chrono>
#include <filesystem>

#include "simulation/observer.hpp"

namespace knap {

/// Replaces the run's checkpoint whenever that much wall-clock time has gone by. Must be the last of the observers, so
/// that the files of the others are never behind it.
class Checkpoints : public Observer {
 public:
  /// `seconds` between two of them; 0 = only when asked.
  Checkpoints(std::filesystem::path path, double seconds);
  void look(const Simulation& s) override;
  /// Writes one now.
  void write(const Simulation& s);

 private:
  using Clock = std::chrono::steady_clock;
  std::filesystem::path path_;
  std::chrono::duration<double> interval_;
  Clock::time_point last_ = Clock::now();
};

}  // namespace knap
