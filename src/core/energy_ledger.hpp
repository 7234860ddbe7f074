#pragma once
#include <array>
#include <string_view>

namespace knap {

/// Where energy can be. The sum over all terms, tool work counted negative, stays what it was at the start.
enum class EnergyTerm {
  Kinetic,             ///< at half steps
  Strain,              ///< stored in the bulk, viscoelastic branch included; at the same half steps
  CohesiveStored,      ///< recoverable on closing a softening crack
  CohesiveDissipated,  ///< work of separation spent
  ClosureImpact,       ///< normal impacts of closing crack faces
  CrackFriction,       ///< sliding of crack faces
  ContactDissipated,   ///< impacts and sliding between established fragments
  ToolFriction,        ///< sliding on walls and tools
  ToolImpact,          ///< nodes landing on a wall (a discretisation loss)
  Viscous,             ///< loss of the viscoelastic branch
  RigidVibration,      ///< vibration lost by fragments that became rigid bodies
  MassScaling,         ///< kinetic energy of mass added at splits, counted negative
  ToolWork,            ///< done by tools of prescribed motion on the particle, counted negative
  ToolKinetic,         ///< of tools with a mass of their own
  Gravity,             ///< potential energy of particle and such tools, 0 at the start
  Count
};

inline constexpr std::size_t num_energy_terms = static_cast<std::size_t>(EnergyTerm::Count);
/// The name of a term in history.csv and report.json.
std::string_view name(EnergyTerm term);

/// The energy of a run by term [J].
struct EnergyLedger {
  std::array<double, num_energy_terms> value{};
  double initial = 0.0;            ///< total at the start [J]
  double reference = 0.0;          ///< what errors are measured against: incident kinetic energy and tools' work [J]
  double max_closure_error = 0.0;  ///< largest |total - initial| / reference so far

  double& operator[](EnergyTerm term) { return value[static_cast<std::size_t>(term)]; }
  double operator[](EnergyTerm term) const { return value[static_cast<std::size_t>(term)]; }
  double total() const;
  /// |total - initial| / reference now.
  double closure_error() const;
};

}  // namespace knap
