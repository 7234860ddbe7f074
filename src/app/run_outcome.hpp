#pragma once
#include <string>

#include "analysis/breakage.hpp"
#include "analysis/compression.hpp"
#include "analysis/sanity_card.hpp"
#include "meshing/mesh_quality.hpp"
#include "observers/fragment_census.hpp"
#include "quasistatic/load_path.hpp"
#include "simulation/run.hpp"

namespace knap {

/// The pieces of the particle by one label.
struct Pieces {
  std::vector<Index> fragment_of_tet;  ///< ids of `fragments`
  std::vector<Fragment> fragments;     ///< the largest first
  BreakageMeasures measures;
};

/// How a session of a run went.
struct Session {
  StopReason stop_reason = StopReason::EndTime;
  std::int64_t first_step = 0;  ///< 0, or that of the checkpoint, which may be 0 too
  bool is_resumed = false;
  double wall_seconds = 0.0;  ///< of the steps, observers included
  int threads = 1;
};

/// How the onset of fracture, from which a run started, was found.
struct OnsetStart {
  double force = 0.0;           ///< between the tools [N]
  double approach = 0.0;        ///< of the tools since both touched [m]
  double speed = 0.0;           ///< of that approach [m/s]
  double strain_energy = 0.0;   ///< [J]
  std::vector<LoadStep> steps;  ///< by approach, the last one at the onset
  int newton_iterations = 0;
  int factorisations = 0;
  double wall_seconds = 0.0;
};

/// What a driven tool found out about the particle's strength.
struct Compression {
  std::string tool;
  ForceCurve curve;
  std::vector<double> smoothed{};  ///< force at the curve's times [N]
  FractureForce fracture{};
};

/// A particle of the case, as it was.
struct ParticleIdentity {
  std::string name;
  double diameter = 0.0;  ///< of the sphere of equal volume [m]
};

/// What became of one of several particles, by the damage label.
struct ParticleOutcome {
  std::string name;
  double mass = 0.0;             ///< [kg]
  Vec3 velocity = Vec3::Zero();  ///< of its largest piece [m/s]
  BreakageMeasures measures{};
};

/// All that report, tables, picture and summary tell.
struct RunOutcome {
  std::string case_name;
  Session session;
  SanityCard card;
  MeshQuality quality;
  Pieces strict;
  Pieces damage;  ///< the ones that breakage is measured by
  CrackCensus cracks;
  Rebound rebound;
  MomentumErrors momentum;
  std::string state_hash;
  std::vector<ParticleOutcome> particles{};  ///< in the order of the case
  std::optional<OnsetStart> onset{};         ///< absent unless the run started there
  std::optional<Compression> compression{};  ///< absent where no tool presses
};

/// What a run is known by before it starts.
struct RunIdentity {
  std::string case_name;
  SanityCard card;
  MeshQuality quality;
  std::vector<ParticleIdentity> particles{};  ///< none = one without a name
  std::optional<OnsetStart> onset{};          ///< absent unless it starts there
};
RunOutcome run_outcome(const Simulation& s, const RunIdentity& identity, const Session& session);

/// "finished", "interrupted" or "failed".
std::string_view status(StopReason reason);
/// For a run that failed: what went wrong, with the ledger term that changed most since the balance was last good.
std::string failure_message(const Simulation& s, StopReason reason);

}  // namespace knap
