#pragma once
#include "contact/tool.hpp"
#include "core/rigid_bodies.hpp"
#include "core/topology.hpp"

namespace knap {

/// What contacts are made of.
struct ContactScene {
  const Topology& topology;
  std::span<const Vec4> x;
  const RigidBodies& rigid;
  std::span<const Tool> tools{};
  double dt = 0.0;  ///< [s]
};

/// The place with these barycentric coordinates in a tet [m].
inline Vec3 place_in(const TetCorners& nodes, const std::array<double, 4>& weights, std::span<const Vec4> x) {
  Vec3 place = Vec3::Zero();
  for (std::size_t k = 0; k < 4; ++k) place += weights[k] * xyz(x[at(nodes[k])]);
  return place;
}

}  // namespace knap
