#include "contact/plane.hpp"

#include "core/parallel.hpp"

namespace knap {
namespace {

constexpr Index nodes_per_block = 2048;

// Raises the normal velocity of a node by `stop` and slows its sliding within the Coulomb cone.
void land(const Plane& plane, NodalState& nodes, Index i, double stop, ToolAction& action) {
  Vec3 v = xyz(nodes.v[at(i)]);
  const Vec3 tangential = v - plane.normal.dot(v) * plane.normal;
  const double speed = tangential.norm();
  const double slowdown = speed > 0.0 ? std::min(1.0, plane.friction * stop / speed) : 0.0;
  const Vec3 normal_impulse = nodes.mass[at(i)] * stop * plane.normal;
  const Vec3 friction_impulse = -nodes.mass[at(i)] * slowdown * tangential;
  v += stop * plane.normal - slowdown * tangential;
  xyz(nodes.v[at(i)]) = v;
  const Vec3 mean = 0.5 * (v + xyz(nodes.v_before[at(i)]));
  action.impulse += normal_impulse + friction_impulse;
  action.moment += Vec3(xyz(nodes.x[at(i)])).cross(normal_impulse + friction_impulse);
  action.impact_loss -= normal_impulse.dot(mean);
  action.friction_loss -= friction_impulse.dot(mean);
  action.nodes.push_back(i);
}

}  // namespace

ToolAction& ToolAction::operator+=(const ToolAction& other) {
  impulse += other.impulse;
  moment += other.moment;
  friction_loss += other.friction_loss;
  impact_loss += other.impact_loss;
  nodes.insert(nodes.end(), other.nodes.begin(), other.nodes.end());
  return *this;
}

ToolAction apply_plane(const Plane& plane, NodalState& nodes, double dt) {
  const double offset = plane.normal.dot(plane.point);
  std::vector<ToolAction> action_of_block(at(num_blocks(nodes.size(), nodes_per_block)));
  parallel_blocks(to_index(action_of_block.size()), [&](Index block) {
    const Index end = std::min(nodes.size(), (block + 1) * nodes_per_block);
    for (Index i = block * nodes_per_block; i < end; ++i) {
      const double gap_after = plane.normal.dot(xyz(nodes.x[at(i)]) + dt * xyz(nodes.v[at(i)])) - offset;
      if (gap_after < 0.0) land(plane, nodes, i, -gap_after / dt, action_of_block[at(block)]);
    }
  });
  ToolAction total;
  for (const ToolAction& action : action_of_block) total += action;
  return total;
}

}  // namespace knap
