#include "loading/body_force.hpp"

#include "core/parallel.hpp"

namespace knap {

GravityImpulse& GravityImpulse::operator+=(const GravityImpulse& other) {
  linear += other.linear;
  angular += other.angular;
  return *this;
}

GravityImpulse add_gravity(NodalState& nodes, const Vec3& gravity, double dt) {
  const Vec4 change = dt * padded(gravity);
  parallel_for(nodes.size(), [&](Index i) { nodes.v[at(i)] += change; });
  return ordered_sum<GravityImpulse>(nodes.size(), [&](Index i) {
    const Vec3 impulse = dt * nodes.mass[at(i)] * gravity;
    return GravityImpulse{impulse, Vec3(xyz(nodes.x[at(i)])).cross(impulse)};
  });
}

double node_potential(const Vec3& gravity, const NodalState& nodes, Index node, double ahead) {
  return -gravity.dot(xyz(nodes.x[at(node)]) + ahead * xyz(nodes.v[at(node)]));
}

double gravity_potential(const NodalState& nodes, const Vec3& gravity, double ahead) {
  return ordered_sum<double>(nodes.size(),
                             [&](Index i) { return nodes.mass[at(i)] * node_potential(gravity, nodes, i, ahead); });
}

}  // namespace knap
