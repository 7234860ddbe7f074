#include "contact/plane.hpp"

#include "core/parallel.hpp"

namespace knap {

ToolAction& ToolAction::operator+=(const ToolAction& other) {
  impulse += other.impulse;
  moment += other.moment;
  friction_loss += other.friction_loss;
  impact_loss += other.impact_loss;
  contacts += other.contacts;
  return *this;
}

ToolAction apply_plane(const Plane& plane, NodalState& nodes, double dt) {
  const double offset = plane.normal.dot(plane.point);
  return ordered_sum<ToolAction>(nodes.size(), [&](Index i) {
    ToolAction action;
    const Vec3 x = xyz(nodes.x[at(i)]);
    Vec3 v = xyz(nodes.v[at(i)]);
    const double gap_after = plane.normal.dot(x + dt * v) - offset;
    if (gap_after >= 0.0) return action;
    const double stop = -gap_after / dt;
    const Vec3 tangential = v - plane.normal.dot(v) * plane.normal;
    const double speed = tangential.norm();
    const double slowdown = speed > 0.0 ? std::min(1.0, plane.friction * stop / speed) : 0.0;
    const double mass = nodes.mass[at(i)];
    const Vec3 normal_impulse = mass * stop * plane.normal;
    const Vec3 friction_impulse = -mass * slowdown * tangential;
    action.impulse = normal_impulse + friction_impulse;
    v += action.impulse / mass;
    xyz(nodes.v[at(i)]) = v;
    const Vec3 mean = 0.5 * (v + xyz(nodes.v_before[at(i)]));
    action.moment = x.cross(action.impulse);
    action.impact_loss = -normal_impulse.dot(mean);
    action.friction_loss = -friction_impulse.dot(mean);
    action.contacts = 1;
    return action;
  });
}

}  // namespace knap
