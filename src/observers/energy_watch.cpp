#include "observers/energy_watch.hpp"

#include <fmt/format.h>

#include "simulation/step.hpp"

namespace knap {

EnergyWatch::EnergyWatch(std::function<void(const std::string&)> warn) : Observer(1), warn_(std::move(warn)) {}

void EnergyWatch::look(const Simulation& s) {
  if (!warned_of_inversion_ && s.totals.smallest_volume_ratio <= 0.0) {
    warned_of_inversion_ = true;
    warn_(
        fmt::format("a tet was turned inside out by {:.4g} us (volume ratio {:.3g}); do not trust what is near it; try "
                    "a finer mesh or a "
                    "smaller run.step_safety",
                    1e6 * s.clock.time(), s.totals.smallest_volume_ratio));
  }
  if (warned_ || s.ledger.max_closure_error <= energy_warning) return;
  warned_ = true;
  warn_(fmt::format(
      "the energy balance is off by {:.2f} % of the incident energy at {:.4g} us; the run stops at {:.0f} %",
      100.0 * s.ledger.max_closure_error, 1e6 * s.clock.time(), 100.0 * energy_stop));
}

}  // namespace knap
