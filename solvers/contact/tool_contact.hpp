#pragma once
#include <span>

#include "contact/tool.hpp"
#include "core/nodal_state.hpp"

namespace knap {

/// The step that tools act in.
struct ToolStep {
  double dt = 0.0;         ///< [s]
  std::int64_t step = 0;   ///< its number
  double tolerance = 0.0;  ///< what began the step deeper than this in a tool stays as deep: it is not thrown out [m]
  std::span<const Index> body_of_node{};  ///< as in RigidBodies: nodes of rigid bodies are left alone
};

/// A point of a tool's edge inside a tet of the particle, against the free face it is nearest to.
struct EdgeTouch {
  Index tool = none;
  std::array<Index, 3> nodes{none, none, none};  ///< of the face
  std::array<double, 3> weights{};               ///< of the point, projected to the face
  Vec3 place = Vec3::Zero();                     ///< [m]
  Vec3 normal = Vec3::Zero();                    ///< unit, out of the particle
  Vec3 push = Vec3::Zero();                      ///< normal impulse on the particle [N s]
  Vec3 drag = Vec3::Zero();                      ///< of friction [N s]
};

/// What a tool's impulses at one place did.
struct ToolDeed {
  Index tool = none;
  Vec3 place = Vec3::Zero();          ///< on the tool [m]
  Vec3 origin = Vec3::Zero();         ///< of the tool at the same time [m]
  Vec3 push = Vec3::Zero();           ///< normal impulse [N s]
  Vec3 drag = Vec3::Zero();           ///< of friction [N s]
  Vec3 mean_velocity = Vec3::Zero();  ///< of the particle there, before and after all impulses [m/s]
  Vec3 lever = Vec3::Zero();          ///< where the impulses act on the particle [m]
};

/// Exact unilateral contact of every node with every tool: where the step would end inside a tool, at tool.next, the
/// impulse that makes it end on the surface (the gap linearised where the step would end), with Coulomb friction
/// against the surface's velocity. Nodes on two tools are solved for both. A guided tool and its nodes are solved
/// together: they end the step in touch, and momentum along the guide is kept to round-off. Edges push first
/// (tool_edges.hpp). Must be the last impulses of a step: the losses are taken at the final velocities. Returns the
/// nodes touched, ascending, each once.
/// `deeds` are what the tools have already done to rigid bodies, to be booked with the rest.
std::vector<Index> apply_tools(std::span<Tool> tools, NodalState& nodes, const ToolStep& step,
                               std::span<EdgeTouch> touches = {}, std::span<const ToolDeed> deeds = {});

}  // namespace knap
