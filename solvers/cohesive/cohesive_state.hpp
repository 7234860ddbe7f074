#pragma once
// The cracks of a run. A crack record is one corner of one cracked facet; the records of an original vertex lie
// together, and no record couples two vertices, so the impulses of one vertex are solved without looking at any other.
#include <span>

#include "cohesive/linear_softening.hpp"
#include "cohesive/record_groups.hpp"
#include "core/topology.hpp"

namespace knap {

enum class RecordRegime : std::uint8_t {
  Virgin,     ///< rigid with a limited capacity: impulses hold the faces together
  Softening,  ///< explicit secant force, and contact where the faces meet
  Failed      ///< contact only
};

/// One corner of a cracked facet: joins node a (minus side) to node b (plus side). One cache line; the vector kernels
/// read it as rows of four doubles.
struct alignas(64) CrackRecord {
  Vec3 impulse = Vec3::Zero();  ///< on b, the opposite on a, without the secant force [N s]
  double d_max = 0.0;           ///< largest effective opening so far [m]
  double strength = 0.0;        ///< effective traction at insertion s0 times the third of the facet [N]
  double delta_c = 1.0;         ///< effective opening at full failure [m]
  Index face = none;            ///< slot of its facet in CrackState::faces
  Index node_a = none;
  Index node_b = none;
  std::uint8_t corner = 0;  ///< 0..2 within the facet
  RecordRegime regime = RecordRegime::Virgin;
  std::uint8_t local_a = 0;  ///< number of node a among the nodes of the vertex, see RecordGroups
  std::uint8_t local_b = 0;

  double damage() const { return std::min(1.0, d_max / delta_c); }
  /// Both sides still share their node: nothing to do until the crack goes round it.
  bool is_closed_tip() const { return node_a == node_b; }
};

/// What becomes of a cracked facet in a step: the fourth entry of its normal, where the vector kernels find it.
namespace face_action {
inline constexpr double none = 0.0;
inline constexpr double rotates = 1.0;            ///< gives angular momentum back
inline constexpr double ends = -1.0;              ///< handed over in this step: no impulses any more
inline constexpr double ends_and_rotates = -2.0;  ///< both
}  // namespace face_action

/// A cracked facet as long as its two faces meet as twins. By cache lines: what the impulses of every step touch, what
/// the faces' own sweep reads, the rotation.
struct alignas(64) CrackFace {
  Vec4 normal = Vec4::Zero();  ///< of the mid-surface, minus to plus; the fourth entry is a face_action
  std::array<Vec4, 3> couple{Vec4::Zero(), Vec4::Zero(), Vec4::Zero()};  ///< jump x impulse of each corner, summed
                                                                         ///< since the last rotation [N m s]
  Vec3 carried_couple = Vec3::Zero();           ///< what the last rotation left to the next [N m s]
  double area = 0.0;                            ///< reference [m2]
  std::array<std::array<Index, 2>, 3> nodes{};  ///< current nodes of the three corners (minus, plus)
  Index facet = none;
  std::array<std::uint8_t, 3> failed{};  ///< per corner
  std::uint8_t sleeps = 0;               ///< both sides belong to one rigid body: no impulses, see sleeping_faces.hpp
  Vec4 rotation = Vec4::Zero();          ///< that gives angular momentum back in this step, if it rotates [rad/s]
  Vec4 centre = Vec4::Zero();            ///< mass centre of the six nodes, if it rotates [m]

  bool rotates() const { return normal[3] > 0.0 || normal[3] == face_action::ends_and_rotates; }
  bool has_ended() const { return normal[3] < 0.0; }
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

/// Everything that cracks have brought into a run. Records are ordered by vertex, faces by facet as far as tidy_faces
/// has seen them, so that a sweep over the vertices walks both in about the order of memory.
struct CrackState {
  std::vector<CrackFace> faces;
  std::vector<Index> face_of_facet;  ///< facet -> slot in faces, none = not cracked or handed over
  std::vector<CrackRecord> records;
  std::vector<Index> record_offsets;               ///< original vertex v has records [offsets[v], offsets[v + 1])
  std::vector<CrackLosses> losses_of_vertex;       ///< up to the last step
  std::vector<CrackLosses> step_losses_of_vertex;  ///< of this step, may still be corrected
  std::vector<Index> vertices;                     ///< those with records, ascending
  std::vector<Index> first_vertices;               ///< of the particles, each with a law of its own
  RecordGroups groups;                             ///< derived: the vertices as the vector kernels take them
  std::vector<Index> awake_faces;                  ///< derived: slots of the faces that do not sleep, if any sleeps
  bool any_sleeps = false;                         ///< derived: some face sleeps
  double cracked_area = 0.0;                       ///< of all facets inserted so far [m2]
  std::int64_t last_damage_step = 0;               ///< last step with an insertion or noticeable damage

  std::span<CrackRecord> records_of_vertex(Index vertex) {
    return {records.data() + record_offsets[at(vertex)], records.data() + record_offsets[at(vertex) + 1]};
  }
  std::span<const CrackRecord> records_of_vertex(Index vertex) const {
    return {records.data() + record_offsets[at(vertex)], records.data() + record_offsets[at(vertex) + 1]};
  }
};

/// The law of a vertex: the number of its particle.
inline Index law_of_vertex(const CrackState& cracks, Index vertex) {
  const auto& first = cracks.first_vertices;
  return static_cast<Index>(std::upper_bound(first.begin(), first.end(), vertex) - first.begin()) - 1;
}

/// No crack anywhere, in particles that begin at these vertices, ascending.
CrackState make_crack_state(const Topology& topology, std::vector<Index> first_vertices = {0});

/// Adds faces and their records, in ascending order of vertex. The records' `face` is the position in `faces` here.
struct VertexRecord {
  Index vertex = none;
  CrackRecord record;
};
void add_cracks(CrackState& cracks, std::span<const CrackFace> faces, std::span<const VertexRecord> records);

/// Brings awake_faces up to date.
void list_awake_faces(CrackState& cracks);

/// Removes the ended faces and their records and puts the faces in the order of their facets.
void tidy_faces(CrackState& cracks);

}  // namespace knap
