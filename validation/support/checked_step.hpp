#pragma once
#include "core/errors.hpp"
#include "simulation/step.hpp"

namespace knap {

/// A step that must succeed. Throws RuntimeFailure if it does not.
inline void checked_step(Simulation& s) {
  const StepStatus status = step(s);
  if (status == StepStatus::NotFinite) throw RuntimeFailure("a step left values that are not finite");
  if (status == StepStatus::EnergyNotClosed) throw RuntimeFailure("the energy balance does not close");
}

}  // namespace knap
