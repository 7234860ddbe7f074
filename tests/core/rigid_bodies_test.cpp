#include "core/rigid_bodies.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

namespace knap {
namespace {

NodalState random_nodes(Index count, unsigned seed) {
  std::mt19937_64 random{seed};
  std::uniform_real_distribution<double> anything{-1.0, 1.0};
  NodalState nodes;
  for (Index i = 0; i < count; ++i) {
    nodes.x.push_back(padded({anything(random), 2.0 + anything(random), anything(random)}));
    nodes.v.push_back(padded({anything(random), anything(random), 3.0 * anything(random)}));
    nodes.mass.push_back(1.5 + anything(random));
  }
  return nodes;
}

std::vector<Index> numbers(Index first, Index last) {
  std::vector<Index> all(at(last - first));
  std::iota(all.begin(), all.end(), first);
  return all;
}

struct Sums {
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
  double energy = 0.0;
};

Sums sums(const NodalState& nodes) {
  Sums total;
  for (std::size_t i = 0; i < nodes.x.size(); ++i) {
    const Vec3 x = xyz(nodes.x[i]), p = nodes.mass[i] * xyz(nodes.v[i]);
    total.linear += p;
    total.angular += x.cross(p);
    total.energy += 0.5 * p.dot(xyz(nodes.v[i]));
  }
  return total;
}

TEST(RigidBody, TakesItsMomentaFromItsNodesAndGivesThemBack) {
  NodalState nodes = random_nodes(12, 1);
  const Sums before = sums(nodes);
  const RigidBody body = make_rigid_body(numbers(0, 12), nodes);
  EXPECT_LT((body.mass * body.velocity - before.linear).norm(), 1e-14 * before.linear.norm());
  EXPECT_LT((body.centre.cross(body.mass * body.velocity) + body.angular_momentum - before.angular).norm(), 1e-13);
  for (std::size_t i = 0; i < nodes.x.size(); ++i) nodes.v[i] = padded(velocity_at(body, xyz(nodes.x[i])));
  const Sums after = sums(nodes);
  EXPECT_LT((after.linear - before.linear).norm(), 1e-13);
  EXPECT_LT((after.angular - before.angular).norm(), 1e-13);
  EXPECT_NEAR(after.energy, kinetic_energy(body), 1e-13 * after.energy);
  EXPECT_LT(after.energy, before.energy);  // the rest was no rigid motion
}

TEST(RigidBody, AnImpulseDoesTheWorkOfTheMeanVelocity) {
  const NodalState nodes = random_nodes(8, 2);
  RigidBody body = make_rigid_body(numbers(0, 8), nodes);
  const Vec3 point(0.3, 1.0, -0.8), impulse(0.5, -2.0, 0.7);
  const double energy = kinetic_energy(body);
  const Vec3 before = velocity_at(body, point);
  apply_impulse(body, point, impulse);
  const Vec3 after = velocity_at(body, point);
  EXPECT_LT((after - before - inverse_mass_at(body, point) * impulse).norm(), 1e-14);
  EXPECT_EQ(velocity_before_at(body, point), before);
  EXPECT_NEAR(kinetic_energy(body) - energy, 0.5 * impulse.dot(before + after), 1e-14);
}

TEST(RigidBodies, TheOthersStayWhatTheyWereWhenOneLeaves) {
  const NodalState nodes = random_nodes(15, 3);
  RigidBodies rigid;
  for (const Index first : {0, 5, 10}) {
    const auto own = numbers(first, first + 5);
    append_body(rigid, make_rigid_body(own, nodes), numbers(first / 5 * 2, first / 5 * 2 + 2), own, nodes.x);
  }
  const RigidBodies before = rigid;
  remove_bodies(rigid, std::array<std::uint8_t, 3>{0, 1, 0});
  ASSERT_EQ(rigid.num_bodies(), 2);
  EXPECT_EQ(rigid.bodies[1].mass, before.bodies[2].mass);
  constexpr std::array<Index, 3> body_of_part{0, none, 1};
  for (Index tet = 0; tet < 6; ++tet) EXPECT_EQ(rigid.of_tet(tet), body_of_part[at(tet / 2)]);
  for (Index node = 0; node < 15; ++node) EXPECT_EQ(rigid.of_node(node), body_of_part[at(node / 5)]);
  EXPECT_EQ(rigid.of_node(15), none);
  EXPECT_EQ(rigid.nodes_of_body[1][0], 10);
  EXPECT_EQ(rigid.place[5], before.place[10]);
  EXPECT_EQ(rigid.place.size(), 10u);
}

}  // namespace
}  // namespace knap
