#include "simulation/run.hpp"

#include "simulation/step.hpp"

namespace knap {
namespace {

// Nothing inserted or damaged, no contact with the wall or between fragments, for the quiet time; and the impact is
// over.
bool is_at_rest(const Simulation& s, const RunLimits& limits) {
  if (s.options.wall && s.totals.first_wall_step < 0) return false;
  const std::int64_t quiet_steps = static_cast<std::int64_t>(limits.quiet_time / s.clock.dt);
  const std::int64_t last = std::max({s.cracks.last_damage_step, s.totals.last_wall_step, s.totals.last_contact_step});
  return s.clock.step - last > quiet_steps;
}

void show(const Simulation& s, std::span<Observer* const> observers, bool all) {
  for (Observer* observer : observers)
    if (all || s.clock.step % observer->interval() == 0) observer->look(s);
}

}  // namespace

std::string_view name(StopReason reason) {
  switch (reason) {
    case StopReason::AtRest:
      return "at rest";
    case StopReason::EndTime:
      return "end time";
    case StopReason::Interrupted:
      return "interrupted";
    case StopReason::EnergyNotClosed:
      return "energy not closed";
    case StopReason::NotFinite:
      return "not finite";
  }
  return "";
}

StopReason run(Simulation& s, const RunLimits& limits, std::span<Observer* const> observers,
               const std::atomic<bool>& interrupt) {
  StopReason reason = StopReason::EndTime;
  while (s.clock.time() < limits.end_time) {
    show(s, observers, false);
    if (interrupt.load(std::memory_order_relaxed)) {
      reason = StopReason::Interrupted;
      break;
    }
    const StepStatus status = step(s);
    if (status == StepStatus::Ok && !(limits.automatic && is_at_rest(s, limits))) continue;
    reason = status == StepStatus::Ok                ? StopReason::AtRest
             : status == StepStatus::EnergyNotClosed ? StopReason::EnergyNotClosed
                                                     : StopReason::NotFinite;
    break;
  }
  show(s, observers, true);
  return reason;
}

}  // namespace knap
