#include "time/rigid_motion.hpp"

#include "core/parallel.hpp"

namespace knap {
namespace {

constexpr Index bodies_per_block = 16;
// The midpoint is found by iteration, each gains a factor of half the angle of the step.
constexpr int most_iterations = 60;
constexpr double round_off = 1e-16;

/// The inverse inertia that the midpoint rule needs to follow I^-1 to fourth order: scale I^-1 + shift 1, with scale
/// further growing by (dt |w|/2)^2. Found by comparing the expansions of both in dt.
struct Pace {
  double scale = 1.0, shift = 0.0;
};

Pace pace(const RigidBody& body, const Vec3& momentum, double dt) {
  const double energy = 0.5 * momentum.dot(body.inverse_inertia * momentum);
  const double square = 0.5 * momentum.squaredNorm();
  const double determinant = body.inertia.determinant();
  const double mixed = body.inertia.trace() / (6.0 * determinant);
  const double dt2 = dt * dt;
  return {1.0 + dt2 * (mixed * square - body.inverse_inertia.trace() * energy / 3.0),
          dt2 * (mixed * energy - square / (3.0 * determinant))};
}

// Angular velocity of the step in body axes, from the angular momentum at its start in body axes.
Vec3 midpoint_spin(const RigidBody& body, const Vec3& momentum, double dt) {
  const Pace p = pace(body, momentum, dt);
  Vec3 middle = momentum, w = Vec3::Zero();
  for (int i = 0; i < most_iterations; ++i) {
    const Vec3 plain = body.inverse_inertia * middle;
    w = (p.scale + 0.25 * dt * dt * plain.squaredNorm()) * plain + p.shift * middle;
    const Vec3 next = momentum + 0.5 * dt * middle.cross(w);
    const double change = (next - middle).squaredNorm();
    middle = next;
    if (change <= round_off * round_off * momentum.squaredNorm()) break;
  }
  return w;
}

bool has_changed(const RigidBody& body) {
  return body.velocity != body.velocity_before || body.angular_momentum != body.angular_momentum_before;
}

}  // namespace

void rotate_freely(RigidBody& body, double dt) {
  if (body.angular_momentum.isZero(0.0)) return;
  const Vec3 w = midpoint_spin(body, body.orientation.conjugate() * body.angular_momentum, dt);
  const Vec3 half = 0.5 * dt * w;
  body.orientation = (body.orientation * Eigen::Quaterniond(1.0, half.x(), half.y(), half.z())).normalized();
  update_inertia(body);
}

void kick(RigidBodies& rigid, const Vec3& acceleration, double dt) {
  parallel_for(
      rigid.num_bodies(),
      [&](Index b) {
        RigidBody& body = rigid.bodies[at(b)];
        body.velocity_before = body.velocity;
        body.angular_momentum_before = body.angular_momentum;
        body.velocity += dt * acceleration;
      },
      bodies_per_block);
}

void drift(RigidBodies& rigid, double dt) {
  parallel_for(
      rigid.num_bodies(),
      [&](Index b) {
        RigidBody& body = rigid.bodies[at(b)];
        body.centre += dt * body.velocity;
        rotate_freely(body, dt);
      },
      bodies_per_block);
}

void place_nodes(const RigidBodies& rigid, NodalState& nodes) {
  parallel_for(
      rigid.num_bodies(),
      [&](Index b) {
        const RigidBody& body = rigid.bodies[at(b)];
        const Mat3 rotation = body.orientation.toRotationMatrix();
        const Vec3 w = spin(body);
        for (Index i = rigid.nodes_of_body.offsets[at(b)]; i < rigid.nodes_of_body.offsets[at(b + 1)]; ++i) {
          const std::size_t node = at(rigid.nodes_of_body.items[at(i)]);
          const Vec3 r = rotation * rigid.place[at(i)];
          nodes.x[node] = padded(body.centre + r);
          nodes.v[node] = padded(body.velocity + w.cross(r));
        }
      },
      bodies_per_block);
}

void update_node_velocities(const RigidBodies& rigid, NodalState& nodes) {
  parallel_for(
      rigid.num_bodies(),
      [&](Index b) {
        const RigidBody& body = rigid.bodies[at(b)];
        if (!has_changed(body)) return;
        const Vec3 w = spin(body);
        for (const Index node : rigid.nodes_of_body[b])
          nodes.v[at(node)] = padded(body.velocity + w.cross(Vec3(xyz(nodes.x[at(node)])) - body.centre));
      },
      bodies_per_block);
}

}  // namespace knap
