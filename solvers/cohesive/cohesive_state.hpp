#pragma once
// The cracks of a run. A crack record is one corner of one cracked facet; the records of an original vertex lie
// together, and no record couples two vertices, so the impulses of one vertex are solved without looking at any other.
#include <span>

#include "cohesive/linear_softening.hpp"
#include "core/topology.hpp"

namespace knap {

enum class RecordRegime : std::uint8_t {
  Virgin,     ///< rigid with a limited capacity: impulses hold the faces together
  Softening,  ///< explicit secant force, and contact where the faces meet
  Failed      ///< contact only
};

/// One corner of a cracked facet: joins node a (minus side) to node b (plus side).
struct CrackRecord {
  Vec3 impulse = Vec3::Zero();  ///< on b, the opposite on a, without the secant force [N s]
  double tributary_area = 0.0;  ///< a third of the facet [m2]
  double s0 = 0.0;              ///< effective traction at insertion [Pa]
  double delta_c = 0.0;         ///< effective opening at full failure [m]
  double d_max = 0.0;           ///< largest effective opening so far [m]
  Index face = none;            ///< slot of its facet in CrackState::faces
  Index node_a = none;
  Index node_b = none;
  std::uint8_t corner = 0;  ///< 0..2 within the facet
  RecordRegime regime = RecordRegime::Virgin;

  double damage() const { return std::min(1.0, d_max / delta_c); }
  /// Both sides still share their node: nothing to do until the crack goes round it.
  bool is_closed_tip() const { return node_a == node_b; }
};

/// A cracked facet as long as its two faces meet as twins. What every step reads of it is in its first cache line.
struct alignas(64) CrackFace {
  Vec3 normal = Vec3::Zero();    ///< of the mid-surface, minus to plus
  Vec3 rotation = Vec3::Zero();  ///< that gives angular momentum back in this step [rad/s]
  bool ended = false;            ///< handed over in this step: no impulses any more
  bool rotates = false;          ///< rotation is not zero
  Vec3 centre = Vec3::Zero();    ///< mass centre of the six nodes, when rotation is not zero [m]
  std::array<Vec3, 3> couple{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};  ///< jump x impulse of each corner, summed
                                                                         ///< since the last rotation [N m s]
  Vec3 carried_couple = Vec3::Zero();  ///< what the last rotation left to the next [N m s]
  double area = 0.0;                   ///< reference [m2]
  Index facet = none;
  std::array<std::array<Index, 2>, 3> nodes{};  ///< current nodes of the three corners (minus, plus)
  std::array<std::uint8_t, 3> failed{};         ///< per corner
};

/// Energy spent at the cracks of one vertex [J].
struct CrackLosses {
  double cohesive = 0.0;        ///< work of separation
  double closure = 0.0;         ///< normal impacts of closing faces
  double friction = 0.0;        ///< sliding of the faces
  double cohesive_shear = 0.0;  ///< the part of `cohesive` that softening records spent in shear

  CrackLosses& operator+=(const CrackLosses& other) {
    cohesive += other.cohesive;
    closure += other.closure;
    friction += other.friction;
    cohesive_shear += other.cohesive_shear;
    return *this;
  }
};

/// Everything that cracks have brought into a run. Faces are ordered by facet and records by vertex, so that a sweep
/// over the vertices walks both in about the order of memory.
struct CrackState {
  std::vector<CrackFace> faces;
  std::vector<Index> face_of_facet;  ///< facet -> slot in faces, none = not cracked or handed over
  std::vector<CrackRecord> records;
  std::vector<Index> record_offsets;               ///< original vertex v has records [offsets[v], offsets[v + 1])
  std::vector<CrackLosses> losses_of_vertex;       ///< up to the last step
  std::vector<CrackLosses> step_losses_of_vertex;  ///< of this step, may still be corrected
  std::vector<Index> vertices;                     ///< those with records, ascending
  double cracked_area = 0.0;                       ///< of all facets inserted so far [m2]
  std::int64_t last_damage_step = 0;               ///< last step with an insertion or growing damage

  std::span<CrackRecord> records_of_vertex(Index vertex) {
    return {records.data() + record_offsets[at(vertex)], records.data() + record_offsets[at(vertex) + 1]};
  }
  std::span<const CrackRecord> records_of_vertex(Index vertex) const {
    return {records.data() + record_offsets[at(vertex)], records.data() + record_offsets[at(vertex) + 1]};
  }
};

/// No crack anywhere.
CrackState make_crack_state(const Topology& topology);

/// Adds faces, in ascending order of facet, and their records, in ascending order of vertex. The records' `face` is the
/// position in `faces` here.
struct VertexRecord {
  Index vertex = none;
  CrackRecord record;
};
void add_cracks(CrackState& cracks, std::span<const CrackFace> faces, std::span<const VertexRecord> records);

/// Removes the ended faces and their records.
void drop_ended_faces(CrackState& cracks);

}  // namespace knap
