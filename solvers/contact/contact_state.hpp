#pragma once
// Contact between different fragments: pairs of tets with a free face that overlap. Impulses act at points shared by
// both bodies, so momenta are kept to round-off.
#include <span>

#include "core/csr.hpp"
#include "core/types.hpp"

namespace knap {

/// Two tets of different fragments that may meet before the next rebuild.
struct ContactCandidate {
  std::array<Index, 2> tets{none, none};  ///< ascending
  std::array<Index, 2> fragments{none, none};
  double due = 0.0;  ///< travel of both fragments together from which on they may touch [m]
};

/// Two tets that overlap: a candidate with its patch (tet_overlap.hpp), which is kept while they move little against
/// each other.
struct Touch {
  Index candidate = none;
  double size = 0.0;                         ///< of the smaller tet: its least height [m]
  double patch_size = 0.0;                   ///< its area without direction [m2]
  std::array<double, 3> area_along_edges{};  ///< of the patch, by the edges from the first tet's first corner [m]
  std::array<double, 4> weights{};           ///< barycentric coordinates of its centre in the first tet
  std::array<std::array<double, 4>, 4> first_in_second{};  ///< likewise of the first tet's corners in the second
  std::array<Vec3, 3> corners{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};  ///< of the patch, for rigid bodies [m]
  Vec3 area = Vec3::Zero();       ///< now: of the patch, from the first to the second tet [m2]
  Vec3 centre = Vec3::Zero();     ///< now [m]
  Vec3 normal = Vec3::Zero();     ///< now: unit, from the first to the second
  std::uint8_t carries_body = 0;  ///< one of the tets belongs to a rigid body
};

/// One body's part of a contact: a rigid body, a tool, or the four nodes of a tet with the barycentric weights of the
/// point.
struct ContactSide {
  Index body = none;
  Index tool = none;
  TetCorners nodes{none, none, none, none};
  std::array<double, 4> weights{};

  bool is_deformable() const { return body == none && tool == none; }
};

/// A point shared by two overlapping tets, or a node of a rigid body on a tool.
struct Contact {
  std::array<Index, 2> tets{none, none};  ///< or key_of_tool and the node
  std::int8_t point = 0;                  ///< number among the points of this pair
  Vec3 place = Vec3::Zero();              ///< [m]
  Vec3 normal = Vec3::Zero();             ///< unit, from the first tet to the second
  Vec3 impulse = Vec3::Zero();            ///< on the second side, the opposite on the first [N s]
  Vec3 rebound = Vec3::Zero();            ///< likewise, of an impact of rigid bodies in this step [N s]
  double gap = 0.0;                       ///< that the step may still close [m]
  std::array<double, 4> anchor{};         ///< barycentric coordinates of the place in the first tet
  std::array<ContactSide, 2> sides{};

  Vec3 total_impulse() const { return impulse + rebound; }
  bool is_of_tool() const { return tets[0] < none; }
};

/// What stands for a tool in the place of a tet: below all tets.
inline Index key_of_tool(Index tool) { return -2 - tool; }

/// Everything but scratch is persistent.
struct ContactState {
  std::vector<Index> fragment_of_tet;        ///< strict labels, as of the last rebuild
  std::vector<std::uint8_t> free_faces;      ///< per tet, bit i = face opposite corner i, as of the last rebuild
  Csr surface_nodes;                         ///< fragment -> nodes of its tets with free faces
  std::vector<double> travel;                ///< per fragment, bound of its way since the last rebuild [m]
  std::vector<double> margin;                ///< per fragment, way up to which the candidates are complete [m]
  std::vector<ContactCandidate> candidates;  ///< by tets
  std::vector<Touch> touches;                ///< by candidate
  std::vector<Contact> contacts;             ///< by tets and point
  Vec3 frame_velocity = Vec3::Zero();        ///< ways are measured in a frame that moves with it [m/s]
  double skin = 0.0;                         ///< least margin [m]
  double dissipated = 0.0;                   ///< since the start [J]
  Index fragments = 1;                       ///< number of strict fragments at the last rebuild
};

}  // namespace knap
