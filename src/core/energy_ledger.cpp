#include "core/energy_ledger.hpp"

#include <cmath>
#include <numeric>

namespace knap {

std::string_view name(EnergyTerm term) {
  static constexpr std::array<std::string_view, num_energy_terms> names{"kinetic",
                                                                        "strain",
                                                                        "cohesive_stored",
                                                                        "cohesive_dissipated",
                                                                        "closure_impact",
                                                                        "crack_friction",
                                                                        "contact_dissipated",
                                                                        "tool_friction",
                                                                        "tool_impact",
                                                                        "viscous",
                                                                        "rigid_vibration",
                                                                        "mass_scaling",
                                                                        "tool_work",
                                                                        "tool_kinetic",
                                                                        "gravity"};
  return names[static_cast<std::size_t>(term)];
}

double EnergyLedger::total() const { return std::accumulate(value.begin(), value.end(), 0.0); }

double EnergyLedger::closure_error() const { return reference > 0.0 ? std::abs(total() - initial) / reference : 0.0; }

}  // namespace knap
