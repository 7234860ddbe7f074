#pragma once
// What a run can resolve and what it will cost, told before it starts: the formulas of physics.md sections 2 and 3 as
// one card. A card only warns; refusals() lists what should keep a run from starting.
#include <optional>
#include <string>
#include <string_view>

#include "core/types.hpp"

namespace knap {

/// The cohesive law's parameters that set a length.
struct FractureScale {
  double strength = 0.0;              ///< sigma_c [Pa]
  double fracture_energy = 0.0;       ///< mode I G_c [J/m2]
  double shear_strength_ratio = 1.0;  ///< beta [-]
  double mode_ii_ratio = 1.0;         ///< mode II over mode I fracture energy [-]
  double crushed_zone_facets = 0.0;   ///< facets across the crushed zone that mode_ii_ratio is meant for; 0 = any
};

struct TimeStepScale {
  double dt = 0.0;         ///< [s]
  std::string limited_by;  ///< what sets it, for the reader; may be empty
};

struct SanityInput {
  double young_modulus = 0.0;               ///< E [Pa]
  double poisson_ratio = 0.0;               ///< nu [-]
  double density = 0.0;                     ///< rho, envelope [kg/m3]
  std::optional<FractureScale> fracture{};  ///< absent: an elastic run
  double diameter = 0.0;                    ///< of the sphere of equal volume [m]
  double volume = 0.0;                      ///< of the particle [m3]
  double speed = 0.0;                       ///< at which the particle and a wall, tool or other particle meet [m/s]
  double angle = 0.0;                       ///< from the wall plane [rad]; pi/2 = normal
  double press_time = 0.0;                  ///< a tool goes on pressing for that long at the latest [s]; 0 = an impact
  double contact_element_size = 0.0;        ///< mean edge at the contact [m]
  double element_size = 0.0;                ///< mean edge far from it [m]
  Index num_tets = 0;
  std::optional<TimeStepScale> time_step{};
  std::optional<double> end_time{};  ///< [s]; absent = the run stops by itself
  double cost_per_tet_step = 0.0;    ///< expected wall time of one tet in one step [s]; 0 = not known
};

enum class Verdict { Ok, Coarse, Refused };
/// "ok", "coarse", "refused".
std::string_view name(Verdict verdict);

/// A length the mesh must resolve.
struct ResolvedLength {
  double length = 0.0;        ///< [m]
  double element_size = 0.0;  ///< of the mesh where it matters [m]
  double wanted = 0.0;        ///< elements from which it is resolved
  double least = 0.0;         ///< elements below which the run is refused; 0 = never

  double elements() const { return element_size > 0.0 ? length / element_size : 0.0; }
  Verdict verdict() const;
};

struct FractureCard {
  double characteristic_length = 0.0;  ///< l_ch = E' G_c / sigma_c^2, E' = E / (1 - nu^2) (Hillerborg 1976) [m]
  ResolvedLength cohesive_zone{};      ///< 0.88 l_ch (Falk, Needleman & Rice 2001) over the far element size
  ResolvedLength shear_zone{};         ///< l_ch / beta^2 over the contact element size
  double crushed_facets = 0.0;         ///< across the crushed zone, which share the slip
  double mode_ii_ratio = 0.0;          ///< for this number of them [-]
  double crushed_zone_energy = 0.0;    ///< mode II energy of the crushed zone over G_c: mode_ii_ratio times the factor
  double final_opening = 0.0;          ///< delta_c = 2 G_c / sigma_c [m]
  double critical_speed = 0.0;         ///< normal speed at which 0.9 F / d^2 of Hertz's peak force is sigma_c [m/s]
};

struct SanityCard {
  SanityInput input;
  double normal_speed = 0.0;        ///< [m/s]
  double p_wave_speed = 0.0;        ///< sqrt((lambda + 2 mu) / rho) [m/s]
  double s_wave_speed = 0.0;        ///< sqrt(mu / rho) [m/s]
  double crossing_time = 0.0;       ///< d / c_p [s]
  double contact_time = 0.0;        ///< Hertz [s]
  double peak_force = 0.0;          ///< Hertz [N]
  ResolvedLength contact_radius{};  ///< Hertz, over the contact element size
  std::optional<FractureCard> fracture{};
  double end_time = 0.0;   ///< given, or expected: 10 crossings after the contact, at least 50 crossings [s]
  double num_steps = 0.0;  ///< 0 = not known
  double wall_time = 0.0;  ///< [s]; 0 = not known
};

SanityCard sanity_card(const SanityInput& input);

/// Facets in series across the zone that is crushed under a contact: the shorter of the shear process zone and of the
/// contact radius at the critical speed, over the element size there; at least one.
double crushed_facets(const SanityInput& input);
/// Mode II energy over G_c that gives the crushed zone of this mesh the energy that mode_ii_ratio means.
double mesh_mode_ii_ratio(const SanityInput& input);

/// Mode II energy of a zone of `facets` facets in series, shorter than the shear process zone, over that of one facet.
/// With linear softening all slip together until their slips add up to delta_c (2 - 1/N), then one of them goes on
/// alone (1 - 1/N)^2: 3 - 3/N + 1/N^2. 1 for one facet or less.
double shared_slip_factor(double facets);

/// The card as aligned text for terminal and log, one line a number, with verdicts.
std::string format_sanity_card(const SanityCard& card);

/// Why the run should not start, each with what would mend it; empty if it may.
std::vector<std::string> refusals(const SanityCard& card);

}  // namespace knap
