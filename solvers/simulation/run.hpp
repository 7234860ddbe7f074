#pragma once
#include <atomic>
#include <optional>
#include <span>

#include "simulation/observer.hpp"

namespace knap {

/// A tool whose force ends a run by falling, once something has cracked.
struct ForceDrop {
  std::size_t tool = 0;     ///< index of it
  double share = 0.5;       ///< ends the run when the force is below this part of its largest
  double least = 0.0;       ///< a largest force below this is the particle finding its place [N]
  std::int64_t window = 1;  ///< steps that the force is a mean over
};

/// When a run ends.
struct RunLimits {
  double end_time = 0.0;  ///< latest [s]
  bool automatic = true;  ///< earlier, when nothing happens any more
  std::optional<ForceDrop> force_drop{};
  double quiet_time = 0.0;  ///< without contact, insertion, or damage of 1e-5 of the incident energy, for that [s]
};

enum class StopReason { AtRest, EndTime, ForceDropped, Interrupted, EnergyNotClosed, NotFinite };
std::string_view name(StopReason reason);

/// Whether the particle has met any of its tools; true if there are none.
bool has_touched_a_tool(const Simulation& s);

/// Steps until a limit, a failure or `interrupt`; the observers look at the state every few steps and at the end.
StopReason run(Simulation& s, const RunLimits& limits, std::span<Observer* const> observers,
               const std::atomic<bool>& interrupt);

}  // namespace knap
