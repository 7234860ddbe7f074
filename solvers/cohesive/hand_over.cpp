#include "cohesive/hand_over.hpp"

#include <algorithm>
#include <limits>

namespace knap {
namespace {

bool has_parted(const CrackFace& face, std::span<const Vec4> x, bool one_fragment, const HandOverOptions& options) {
  const double size = options.facet_size[at(face.facet)];
  double smallest = std::numeric_limits<double>::max(), largest = 0.0;
  for (const auto& [a, b] : face.nodes) {
    const double jump = (xyz(x[at(b)]) - xyz(x[at(a)])).norm();
    smallest = std::min(smallest, jump);
    largest = std::max(largest, jump);
  }
  if (one_fragment) return smallest > options.jump_within * size;
  return smallest > options.jump_everywhere * size || largest > options.jump_somewhere * size;
}

bool lets_go(const CrackFace& face, const Topology& topology, std::span<const Vec4> x, const HandOverOptions& options) {
  if (options.lets_go.empty()) return false;
  const auto& [minus, plus] = topology.facet_tets[at(face.facet)];
  if (options.lets_go[at(minus)] == 0 && options.lets_go[at(plus)] == 0) return false;
  const double least = -options.overlap_let_go * options.facet_size[at(face.facet)];
  return std::all_of(face.nodes.begin(), face.nodes.end(), [&](const auto& pair) {
    return (xyz(x[at(pair[1])]) - xyz(x[at(pair[0])])).dot(xyz(face.normal)) >= least;
  });
}

}  // namespace

Index hand_over_faces(CrackState& cracks, Topology& topology, std::span<const Vec4> x,
                      std::span<const Index> fragment_of_tet, const HandOverOptions& options) {
  Index count = 0;
  for (CrackFace& face : cracks.faces) {
    if (topology.facet_state[at(face.facet)] != FacetState::Failed || face.sleeps) continue;
    const auto& [minus, plus] = topology.facet_tets[at(face.facet)];
    const bool one_fragment = fragment_of_tet[at(minus)] == fragment_of_tet[at(plus)];
    const bool released = !one_fragment && lets_go(face, topology, x, options);
    if (!released && !has_parted(face, x, one_fragment, options)) continue;
    topology.facet_state[at(face.facet)] = FacetState::HandedOver;
    face.normal[3] = face.rotates() ? face_action::ends_and_rotates : face_action::ends;
    ++count;
  }
  return count;
}

std::vector<FragmentJoint> fragment_joints(const CrackState& cracks, const Topology& topology,
                                           std::span<const Index> fragment_of_tet) {
  std::vector<FragmentJoint> joints;
  for (const CrackFace& face : cracks.faces) {
    if (face.has_ended()) continue;
    const auto& [minus, plus] = topology.facet_tets[at(face.facet)];
    const auto [low, high] = std::minmax(fragment_of_tet[at(minus)], fragment_of_tet[at(plus)]);
    if (low == high) continue;
    for (int k = 0; k < 3; ++k) joints.push_back({topology.facet_vertex(face.facet, k), {low, high}});
  }
  std::sort(joints.begin(), joints.end());
  joints.erase(std::unique(joints.begin(), joints.end()), joints.end());
  return joints;
}

}  // namespace knap
