#pragma once
#include "cohesive/cohesive_state.hpp"
#include "cohesive/insertion_criterion.hpp"
#include "cohesive/intrinsic_bonds.hpp"
#include "cohesive/vertex_impulses.hpp"
#include "contact/contact_impulses.hpp"
#include "contact/tool_edges.hpp"
#include "core/energy_ledger.hpp"
#include "core/nodal_state.hpp"
#include "core/rigid_bodies.hpp"
#include "fem/elastic_force.hpp"
#include "loading/body_force.hpp"
#include "simulation/options.hpp"
#include "simulation/phase_times.hpp"
#include "time/central_difference.hpp"

namespace knap {

struct Clock {
  double dt = 0.0;        ///< [s]
  std::int64_t step = 0;  ///< steps done
  double time() const { return dt * static_cast<double>(step); }
};

/// What never changes once the meshes are known. Vertices, tets and facets of a particle are consecutive.
struct ReferenceState {
  std::vector<Index> particle_of_tet;
  std::vector<CohesiveLaw> laws;         ///< by particle
  std::vector<double> pair_friction;     ///< [-], by pair of particles, row by row; in a particle: of its fragments
  std::vector<Vec3> vertices;            ///< [m]
  std::vector<double> tet_volume;        ///< [m3]
  std::vector<double> corner_mass;       ///< per tet, a quarter of its mass [kg]
  std::vector<double> corner_stiffness;  ///< per corner, of the time-step bound [N/m]
  std::vector<double> facet_area;        ///< [m2]
  std::vector<double> facet_size;        ///< h = 1.5 (V_minus + V_plus)/A [m]
  std::vector<double> facet_strength;    ///< [Pa], infinite in unbreakable particles; empty if all are
  IntrinsicBonds bonds;                  ///< their facets' strengths are here, infinite above
  std::vector<double> fracture_energy;   ///< per facet [J/m2]
  double mean_edge = 0.0;                ///< [m]
  double critical_step = 0.0;            ///< bound of the unbroken mesh [s]
  Momentum start;                        ///< momenta at the start
  double incident_energy = 0.0;          ///< kinetic at the start [J]; of several particles without a tool: about their
                                         ///< common mass centre
  double start_potential = 0.0;          ///< of gravity [J]
  std::vector<Vec3> tool_path;           ///< by tool: how far it had come at time 0 [m]; empty unless the run starts at
                                         ///< the onset of fracture
};

/// Of the tool whose falling force may end the run, see run.hpp.
struct ForceWatch {
  Vec3 impulse = Vec3::Zero();  ///< at the end of the last window [N s]
  double largest = 0.0;         ///< mean force of a window [N]
};

/// Sums over the run that no state variable holds.
struct RunTotals {
  double mass_scaling_energy = 0.0;     ///< [J]
  double added_mass = 0.0;              ///< by mass scaling [kg]
  Vec3 added_linear = Vec3::Zero();     ///< momentum of that mass [kg m/s]
  Vec3 added_angular = Vec3::Zero();    ///< about the origin [kg m2/s]
  GravityImpulse gravity;               ///< on the particle
  std::int64_t last_contact_step = -1;  ///< last step with a general contact pushing
  std::int64_t inserted_facets = 0;
  ForceWatch force_watch{};
  double noted_damage = 0.0;  ///< energy that the cracks had spent when damage was last noticed, see run.cpp [J]
  double smallest_volume_ratio = 1.0;  ///< J of a tet at any energy balance [-], <= 0 = one was inverted
};

/// What freezing remembers; empty unless fragments may become rigid.
struct FreezingState {
  std::vector<std::int64_t> last_change;  ///< by tet: step of the last insertion, damage or waking around it
  std::vector<double> noted_damage;       ///< by facet: mean over its corners when a change was last noticed, -1 = none
  std::vector<std::uint8_t> lets_go;      ///< by tet: crack faces alone keep its fragment from freezing
  double vibration = 0.0;                 ///< energy that freezing has taken so far [J]
};

/// A run: owns everything by value, has no methods.
struct Simulation {
  SimulationOptions options;
  ReferenceState reference;
  Topology topology;
  NodalState nodes;
  ElasticForce elastic;
  CrackState cracks;
  ContactState contact;
  RigidBodies rigid;
  FreezingState freezing;
  std::vector<Tool> tools;  ///< in the order of options.tools
  std::vector<PrescribedNodes> prescribed;
  EdgeWatch tool_edges;               ///< for which of the particle's faces
  std::vector<Index> nodes_on_tools;  ///< touched in the running step, ascending
  EnergyLedger ledger;
  EnergyLedger last_good_ledger;  ///< the last one that closed within energy_warning
  RunTotals totals;
  Clock clock;
  PhaseTimes phase_times{};
};

/// Whether the run starts under load, at the onset of fracture.
inline bool starts_at_onset(const Simulation& s) { return !s.reference.tool_path.empty(); }

/// How far a tool is from where the case puts it [m].
inline Vec3 tool_displacement(const Simulation& s, std::size_t tool) {
  const Vec3 way = s.tools[tool].state.position - s.options.tools[tool].position;
  return starts_at_onset(s) ? Vec3(s.reference.tool_path[tool] + way) : way;
}

}  // namespace knap
