#pragma once
#include <atomic>
#include <span>

#include "simulation/observer.hpp"

namespace knap {

/// When a run ends.
struct RunLimits {
  double end_time = 0.0;    ///< latest [s]
  bool automatic = true;    ///< earlier, when nothing happens any more
  double quiet_time = 0.0;  ///< without contact, insertion, or damage of 1e-5 of the incident energy, for that [s]
};

enum class StopReason { AtRest, EndTime, Interrupted, EnergyNotClosed, NotFinite };
std::string_view name(StopReason reason);

/// Whether the particle has met any of its tools; true if there are none.
bool has_touched_a_tool(const Simulation& s);

/// Steps until a limit, a failure or `interrupt`; the observers look at the state every few steps and at the end.
StopReason run(Simulation& s, const RunLimits& limits, std::span<Observer* const> observers,
               const std::atomic<bool>& interrupt);

}  // namespace knap
