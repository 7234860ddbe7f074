#pragma once
#include <array>
#include <chrono>
#include <string_view>

namespace knap {

/// The phases of a step, as listed in report.json.
enum class Phase {
  Insertion,
  BulkForces,
  CrackFaces,
  ContactDetection,
  VertexImpulses,
  ContactImpulses,
  Tools,
  RigidBodies,
  Booking,
  Ledger,
  Motion,
  Count
};

inline constexpr std::size_t num_phases = static_cast<std::size_t>(Phase::Count);

inline std::string_view name(Phase phase) {
  constexpr std::array<std::string_view, num_phases> names{
      "insertion",       "bulk_forces",      "crack_faces", "contact_detection",
      "vertex_impulses", "contact_impulses", "tools",       "rigid_bodies",
      "booking",         "ledger",           "motion"};
  return names[static_cast<std::size_t>(phase)];
}

/// Wall-clock time by phase [s].
using PhaseTimes = std::array<double, num_phases>;

/// Adds the time between its construction and destruction to a phase.
class PhaseTimer {
 public:
  PhaseTimer(PhaseTimes& times, Phase phase) : time_(times[static_cast<std::size_t>(phase)]) {}
  ~PhaseTimer() { time_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  PhaseTimer(const PhaseTimer&) = delete;
  PhaseTimer& operator=(const PhaseTimer&) = delete;

 private:
  double& time_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace knap
