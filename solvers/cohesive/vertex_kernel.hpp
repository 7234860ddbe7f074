#pragma once
// Vector kernels of the vertex impulses over groups of eight vertices, compiled for several instruction sets and chosen
// at run time. A group's nodes are copied into a local buffer of rows (x y z w) by local number and lane, where the
// sweeps find them in the first-level cache; the bits do not depend on the width of the vectors.
#include <span>

#include "cohesive/cohesive_state.hpp"

namespace knap {

/// The numbers of law and step, as the kernels use them.
struct ImpulseCoefficients {
  CohesiveLaw law;
  double dt = 0.0;  ///< [s]
  int sweeps = 2;
  double virgin_factor = 0.0;  ///< opening over strength times inverse masses up to which records are virgin [s2]
};

/// What the kernels read and write; nodal vectors are padded to four doubles.
struct ImpulseView {
  const RecordGroups* groups = nullptr;
  const Index* record_offsets = nullptr;  ///< of the vertices
  CrackRecord* records = nullptr;
  CrackFace* faces = nullptr;
  const double* x = nullptr;
  double* v = nullptr;
  const double* v_before = nullptr;
  const double* mass = nullptr;
  CrackLosses* losses = nullptr;       ///< per vertex, up to the last step
  CrackLosses* step_losses = nullptr;  ///< per vertex, of this step
  bool any_sleeps = false;             ///< some face sleeps; its records are not booked
};

using LaneValues = std::array<double, std::size_t{group_lanes}>;
using LaneVector = std::array<LaneValues, 3>;

/// What the sweeps need of the k-th records of a group, gathered once a step.
struct alignas(64) RecordRow {
  LaneVector normal, impulse;
  LaneValues inverse_mass_a, inverse_mass_b, effective_mass;
  LaneValues closing_impulse;  ///< that the gap leaves free [N s]
  LaneValues shear_capacity;   ///< beta times the capacity of tension, virgin records only [N s]
  LaneValues friction;         ///< coefficient [-]
  LaneVector jump, secant_impulse;
  LaneValues d_max;             ///< [m]
  LaneValues virgin;            ///< 1 or 0
  PerLane<std::uint16_t> a, b;  ///< offsets of the local rows of the nodes [doubles]
  bool rotates = false;         ///< any lane
};

/// Mass times rotation velocity of the nodes of the k-th records of a group, if any of them rotates [kg m/s].
struct alignas(64) SpinRow {
  LaneVector a, b;
};

/// Local rows of one node number: a row of four doubles for each lane.
struct alignas(64) NodeRow {
  std::array<std::array<double, 4>, std::size_t{group_lanes}> x;         ///< position, inverse mass
  std::array<std::array<double, 4>, std::size_t{group_lanes}> v;         ///< velocity
  std::array<std::array<double, 4>, std::size_t{group_lanes}> v_before;  ///< before the step; then its mean
};

/// Working memory of one thread.
struct ImpulseWorkspace {
  std::vector<RecordRow> rows;
  std::vector<SpinRow> spins;
  std::vector<NodeRow> nodes;
  CrackRecord idle_record;  ///< of lanes without a record: a closed tip without strength
  CrackFace idle_face;
  Vec4 idle_node = Vec4::Zero();
};

/// Impulses of the vertices of the groups [first, last) on the free velocities, with coefficients by law; damage grows.
void solve_groups(const ImpulseView& view, const ImpulseCoefficients* k, Index first, Index last,
                  ImpulseWorkspace& workspace);
/// Books anew what the impulses of up to eight vertices spend at the present velocities.
void book_vertices(const ImpulseView& view, const ImpulseCoefficients& k, std::span<const Index> vertices,
                   ImpulseWorkspace& workspace);

}  // namespace knap
