#pragma once
// The cracks of a run. A crack record is one corner of one cracked facet; the records of an original vertex lie
// together, and no record couples two vertices, so the impulses of one vertex are solved without looking at any other.
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
  Vec3 impulse = Vec3::Zero();    ///< on b, the opposite on a, without the secant force [N s]
  Vec3 secant = Vec3::Zero();     ///< restoring traction of the softening branch on b, times -1 [Pa]
  double tributary_area = 0.0;    ///< a third of the facet [m2]
  double s0 = 0.0;                ///< effective traction at insertion [Pa]
  double delta_c = 0.0;           ///< effective opening at full failure [m]
  double d_max = 0.0;             ///< largest effective opening so far [m]
  double dissipated = 0.0;        ///< work of separation spent [J]
  double dissipated_shear = 0.0;  ///< its part spent by the tangential jump [J]
  Index face = none;              ///< slot of its facet in CrackState::faces
  Index node_a = none;
  Index node_b = none;
  std::uint8_t corner = 0;  ///< 0..2 within the facet
  RecordRegime regime = RecordRegime::Virgin;

  double damage() const { return std::min(1.0, d_max / delta_c); }
};

/// A cracked facet as long as its two faces meet as twins.
struct CrackFace {
  Index facet = none;
  std::array<std::array<Index, 2>, 3> nodes{};  ///< current nodes of the three corners (minus, plus)
  Vec3 normal = Vec3::Zero();                   ///< of the mid-surface, minus to plus
  std::array<Vec3, 3> couple{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};  ///< jump x impulse of each corner [N m s]
  Vec3 centre = Vec3::Zero();                                            ///< mass centre of the six nodes [m]
  Vec3 rotation = Vec3::Zero();          ///< angular velocity that undoes the last couple [rad/s]
  double area = 0.0;                     ///< reference [m2]
  std::array<std::uint8_t, 3> failed{};  ///< per corner
};

/// Energy spent at the cracks of one vertex, accumulated over the run [J].
struct CrackLosses {
  double cohesive = 0.0;
  double closure = 0.0;
  double friction = 0.0;
  double cohesive_shear = 0.0;  ///< the part of `cohesive` that handed-over records spent in shear
};

/// Everything that cracks have brought into a run.
struct CrackState {
  std::vector<CrackFace> faces;
  std::vector<Index> face_of_facet;  ///< facet -> slot in faces, none = not cracked or handed over
  std::vector<std::vector<CrackRecord>> records_of_vertex;  ///< original vertex -> its records
  std::vector<CrackLosses> losses_of_vertex;
  std::vector<Index> vertices;        ///< those with records, ascending
  double cracked_area = 0.0;          ///< of all facets inserted so far [m2]
  std::int64_t last_damage_step = 0;  ///< last step with an insertion or growing damage
};

}  // namespace knap
