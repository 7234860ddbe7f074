#pragma once
// Contact between different fragments: points of one (surface nodes, centres of free faces) against tets of another
// that have a free face. Impulses act at one point shared by both bodies, so momenta are kept to round-off.
#include "core/topology.hpp"

namespace knap {

/// A free face of a tet, by the local index of the opposite corner, or a single node: what can touch a tet.
struct ContactPoint {
  std::array<Index, 3> nodes{none, none, none};  ///< one node (the others none), or the corners of a free face
  std::int64_t key = 0;                          ///< node, or num_nodes-independent id of the face: -(corner + 1)
  Index fragment = none;

  bool is_node() const { return nodes[1] == none; }
};

/// A point and a tet that may meet before the next rebuild.
struct ContactCandidate {
  Index point = none;
  Index tet = none;
  double due = 0.0;  ///< ContactState::travel from which on they may touch [m]
};

/// A point inside a foreign tet.
struct Contact {
  std::int64_t point_key = 0;
  Index tet = none;
  std::int8_t face = 0;             ///< local index of the free face it went in by
  Vec3 impulse = Vec3::Zero();      ///< on the point [N s]
  Vec3 normal = Vec3::Zero();       ///< of that face, outwards
  std::array<Index, 7> nodes{};     ///< three of the point, four of the tet
  std::array<double, 7> weights{};  ///< relative velocity = sum of weight x velocity
  double depth = 0.0;               ///< [m]
};

struct ContactState {
  std::vector<Index> fragment_of_tet;    ///< strict labels, as of the last rebuild
  std::vector<std::uint8_t> free_faces;  ///< per tet, bit i = face opposite corner i, as of the last rebuild
  std::vector<ContactPoint> points;
  std::vector<ContactCandidate> candidates;  ///< by tet
  std::vector<Contact> contacts;             ///< by point and tet
  double travel = 0.0;                       ///< no two nodes have come nearer than by this since the last rebuild [m]
  double skin = 0.0;                         ///< candidates are complete for a travel up to this [m]
  double dissipated = 0.0;                   ///< since the start [J]
  Index fragments = 1;                       ///< number of strict fragments at the last rebuild
};

}  // namespace knap
