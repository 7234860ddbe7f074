#pragma once
#include <span>

#include "simulation/simulation.hpp"

namespace knap {

/// A fragment that may be frozen.
struct QuietFragment {
  std::vector<Index> tets;   ///< ascending
  std::vector<Index> nodes;  ///< ascending
  RigidBody body;            ///< as its nodes move
  double vibration = 0.0;    ///< kinetic energy beside the rigid motion [J]
  bool is_loose = false;     ///< all its crack faces are in the hands of the general contact
};

/// Whether a node of the body is nearer to a triangulated tool than this distance [m].
bool is_near_triangulated_tool(const Simulation& s, std::span<const Index> nodes, const RigidBody& body,
                               double distance);

/// Notes which tets have had a facet cracked or noticeably damaged since the last call; at every look for fragments.
void note_changes(Simulation& s);

/// The deformable fragments that meet all the conditions of RigidFragmentOptions, in the order of their labels, those
/// that are not loose yet included.
std::vector<QuietFragment> quiet_fragments(const Simulation& s);

}  // namespace knap
