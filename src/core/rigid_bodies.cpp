#include "core/rigid_bodies.hpp"

#include <algorithm>

namespace knap {
namespace {

// Where item i of the old numbering goes: the number of those that stay before it, none if it leaves.
std::vector<Index> new_numbers(std::span<const std::uint8_t> leaves) {
  std::vector<Index> number(leaves.size(), none);
  Index next = 0;
  for (std::size_t i = 0; i < leaves.size(); ++i)
    if (leaves[i] == 0) number[i] = next++;
  return number;
}

void renumber(std::vector<Index>& values, const std::vector<Index>& number) {
  for (Index& value : values)
    if (value != none) value = number[at(value)];
}

void assign_all(std::vector<Index>& values, std::span<const Index> items, Index value) {
  for (const Index item : items) {
    if (at(item) >= values.size()) values.resize(at(item) + 1, none);
    values[at(item)] = value;
  }
}

}  // namespace

RigidBody make_rigid_body(std::span<const Index> nodes, const NodalState& state) {
  RigidBody body;
  Vec3 first = Vec3::Zero(), linear = Vec3::Zero();
  for (const Index node : nodes) {
    const double mass = state.mass[at(node)];
    body.mass += mass;
    first += mass * xyz(state.x[at(node)]);
    linear += mass * xyz(state.v[at(node)]);
  }
  body.centre = first / body.mass;
  body.velocity = body.velocity_before = linear / body.mass;
  for (const Index node : nodes) {
    const Vec3 r = xyz(state.x[at(node)]) - body.centre;
    const Vec3 v = xyz(state.v[at(node)]) - body.velocity;
    body.radius = std::max(body.radius, r.norm());
    body.angular_momentum += state.mass[at(node)] * r.cross(v);
    body.inertia += state.mass[at(node)] * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
  }
  body.angular_momentum_before = body.angular_momentum;
  body.inverse_inertia = body.inverse_inertia_world = body.inertia.inverse();
  return body;
}

void append_body(RigidBodies& rigid, const RigidBody& body, std::span<const Index> tets, std::span<const Index> nodes,
                 std::span<const Vec4> x) {
  const Index number = rigid.num_bodies();
  rigid.bodies.push_back(body);
  rigid.approach.push_back(0.0);
  rigid.push.push_back(0.0);
  assign_all(rigid.body_of_tet, tets, number);
  assign_all(rigid.body_of_node, nodes, number);
  rigid.nodes_of_body.items.insert(rigid.nodes_of_body.items.end(), nodes.begin(), nodes.end());
  rigid.nodes_of_body.offsets.push_back(to_index(rigid.nodes_of_body.items.size()));
  for (const Index node : nodes)
    rigid.place.push_back(body.orientation.conjugate() * Vec3(xyz(x[at(node)]) - body.centre));
}

void remove_bodies(RigidBodies& rigid, std::span<const std::uint8_t> leaves) {
  const auto number = new_numbers(leaves);
  RigidBodies kept;
  for (Index b = 0; b < rigid.num_bodies(); ++b) {
    if (leaves[at(b)] != 0) continue;
    kept.bodies.push_back(rigid.bodies[at(b)]);
    const auto nodes = rigid.nodes_of_body[b];
    kept.nodes_of_body.items.insert(kept.nodes_of_body.items.end(), nodes.begin(), nodes.end());
    kept.nodes_of_body.offsets.push_back(to_index(kept.nodes_of_body.items.size()));
    const auto first = rigid.place.begin() + rigid.nodes_of_body.offsets[at(b)];
    kept.place.insert(kept.place.end(), first, first + static_cast<std::ptrdiff_t>(nodes.size()));
  }
  renumber(rigid.body_of_node, number);
  renumber(rigid.body_of_tet, number);
  clear_contact_reports(kept);
  rigid.bodies = std::move(kept.bodies);
  rigid.approach = std::move(kept.approach);
  rigid.push = std::move(kept.push);
  rigid.nodes_of_body = std::move(kept.nodes_of_body);
  rigid.place = std::move(kept.place);
}

void clear_contact_reports(RigidBodies& rigid) {
  rigid.approach.assign(rigid.bodies.size(), 0.0);
  rigid.push.assign(rigid.bodies.size(), 0.0);
}

void update_inertia(RigidBody& body) {
  const Mat3 rotation = body.orientation.toRotationMatrix();
  body.inverse_inertia_world = rotation * body.inverse_inertia * rotation.transpose();
}

Mat3 inverse_mass_at(const RigidBody& body, const Vec3& point) {
  const Vec3 r = point - body.centre;
  Mat3 cross;
  cross << 0.0, -r.z(), r.y(), r.z(), 0.0, -r.x(), -r.y(), r.x(), 0.0;
  return Mat3::Identity() / body.mass - cross * body.inverse_inertia_world * cross;
}

}  // namespace knap
