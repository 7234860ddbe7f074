#include "time/central_difference.hpp"

#include "core/parallel.hpp"

namespace knap {

namespace {

bool is_free(Index node, std::span<const Index> body_of_node) {
  return at(node) >= body_of_node.size() || body_of_node[at(node)] == none;
}

}  // namespace

void kick(NodalState& nodes, double dt, std::span<const Index> body_of_node) {
  parallel_for(nodes.size(), [&](Index i) {
    if (!is_free(i, body_of_node)) return;
    nodes.v_before[at(i)] = nodes.v[at(i)];
    nodes.v[at(i)] += dt / nodes.mass[at(i)] * nodes.f[at(i)];
  });
}

void drift(NodalState& nodes, double dt, std::span<const Index> body_of_node) {
  parallel_for(nodes.size(), [&](Index i) {
    if (is_free(i, body_of_node)) nodes.x[at(i)] += dt * nodes.v[at(i)];
  });
}

double kinetic_energy(const NodalState& nodes) {
  return ordered_sum<double>(nodes.size(),
                             [&](Index i) { return 0.5 * nodes.mass[at(i)] * nodes.v[at(i)].squaredNorm(); });
}

double half_step_work(const NodalState& nodes, double dt) {
  return ordered_sum<double>(nodes.size(), [&](Index i) { return 0.5 * dt * nodes.f[at(i)].dot(nodes.v[at(i)]); });
}

Momentum& Momentum::operator+=(const Momentum& other) {
  linear += other.linear;
  angular += other.angular;
  mass += other.mass;
  first += other.first;
  return *this;
}

Momentum momentum(const NodalState& nodes) {
  return ordered_sum<Momentum>(nodes.size(), [&](Index i) {
    const double m = nodes.mass[at(i)];
    const Vec3 x = xyz(nodes.x[at(i)]), v = xyz(nodes.v[at(i)]);
    return Momentum{m * v, m * x.cross(v), m, m * x};
  });
}

}  // namespace knap
