#include "simulation/run.hpp"

#include <algorithm>
#include <cmath>

#include "simulation/step.hpp"

namespace knap {
namespace {

// Damage is noticed when the work of separation has changed by this share of the incident energy since it last was: a
// piece at rest takes less than 1e-6 in each of ten d/c_p. The alternative, growth of any record's opening in a step,
// never ends: where a cracked piece vibrates some record always gives a little (1e-6 in ten d/c_p: zeolite, 3k tets,
// 12 m/s). A facet that breaks takes 2e-4 (20k tets), and every insertion counts.
constexpr double noticeable_share = 1e-5;

// After a step that has balanced the energies.
void notice_damage(Simulation& s) {
  if ((s.clock.step - 1) % s.options.ledger_interval != 0) return;
  const double spent = s.ledger[EnergyTerm::CohesiveDissipated];
  if (std::abs(spent - s.totals.noted_damage) <= noticeable_share * s.ledger.reference) return;
  s.totals.noted_damage = spent;
  s.cracks.last_damage_step = s.clock.step;
}

// Particles may meet each other, a single one only a tool.
bool has_met_anything(const Simulation& s) {
  if (s.options.particles.size() == 1) return has_touched_a_tool(s);
  return s.totals.last_contact_step >= 0 || (!s.tools.empty() && has_touched_a_tool(s));
}

// Nothing inserted or noticeably damaged, no contact with a tool or between fragments, for the quiet time; and the
// impact is over.
bool is_at_rest(const Simulation& s, const RunLimits& limits) {
  if (!has_met_anything(s)) return false;
  const std::int64_t quiet_steps = static_cast<std::int64_t>(limits.quiet_time / s.clock.dt);
  std::int64_t last = std::max(s.cracks.last_damage_step, s.totals.last_contact_step);
  for (const Tool& tool : s.tools) last = std::max(last, tool.state.last_step);
  return s.clock.step - last > quiet_steps;
}

// After every window of steps; the state keeps what the window before ended with.
bool has_force_dropped(Simulation& s, const ForceDrop& drop) {
  if (s.clock.step % drop.window != 0) return false;
  ForceWatch& watch = s.totals.force_watch;
  const Vec3 impulse = s.tools[drop.tool].state.impulse;
  const double force = (impulse - watch.impulse).norm() / (static_cast<double>(drop.window) * s.clock.dt);
  watch = {impulse, std::max(watch.largest, force)};
  return s.totals.inserted_facets > 0 && watch.largest > drop.least && force < drop.share * watch.largest;
}

void show(const Simulation& s, std::span<Observer* const> observers, bool all) {
  for (Observer* observer : observers)
    if (all || s.clock.step % observer->interval() == 0) observer->look(s);
}

}  // namespace

bool has_touched_a_tool(const Simulation& s) {
  const auto touched = [](const Tool& tool) { return tool.state.first_step >= 0; };
  return s.tools.empty() || std::any_of(s.tools.begin(), s.tools.end(), touched);
}

std::string_view name(StopReason reason) {
  switch (reason) {
    case StopReason::AtRest:
      return "at rest";
    case StopReason::EndTime:
      return "end time";
    case StopReason::ForceDropped:
      return "force dropped";
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
    notice_damage(s);
    const bool has_dropped = limits.force_drop && has_force_dropped(s, *limits.force_drop);
    if (status == StepStatus::Ok && !has_dropped && !(limits.automatic && is_at_rest(s, limits))) continue;
    reason = status == StepStatus::Ok && has_dropped ? StopReason::ForceDropped
             : status == StepStatus::Ok              ? StopReason::AtRest
             : status == StepStatus::EnergyNotClosed ? StopReason::EnergyNotClosed
                                                     : StopReason::NotFinite;
    break;
  }
  show(s, observers, true);
  return reason;
}

}  // namespace knap
