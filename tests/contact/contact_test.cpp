#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "contact/tet_overlap.hpp"
#include "tests/contact/tet_cloud.hpp"
#include "time/central_difference.hpp"

namespace knap {
namespace {

using Pairs = std::set<std::array<Index, 2>>;

Pairs brute_force(const Cloud& cloud) {
  Pairs pairs;
  for (Index a = 0; a < cloud.topology.num_tets(); ++a)
    for (Index b = a + 1; b < cloud.topology.num_tets(); ++b) {
      const TetShape first = make_tet_shape(cloud.topology.tet_nodes[at(a)], cloud.nodes.x);
      const TetShape second = make_tet_shape(cloud.topology.tet_nodes[at(b)], cloud.nodes.x);
      if (!first.is_solid || !second.is_solid) continue;
      if (separation_by_faces(first, second) == 0.0 && separation_by_edges(first, second) == 0.0) pairs.insert({a, b});
    }
  return pairs;
}

Pairs found(const Cloud& cloud) {
  Pairs pairs;
  for (const Contact& contact : cloud.contact.contacts) pairs.insert(contact.tets);
  return pairs;
}

TEST(BroadPhase, FindsWhatBruteForceFinds) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    Cloud cloud = make_tet_cloud(150, 4.0, seed);
    cloud.rebuild(1e-3);
    cloud.refresh();
    const Pairs expected = brute_force(cloud);
    EXPECT_GT(expected.size(), 20u);
    EXPECT_EQ(found(cloud), expected);
  }
}

// All pairs that overlap; and a pair that has parted stays for 2 % of a height.
void expect_those_and_hardly_parted_ones(const Cloud& cloud) {
  const Pairs now = found(cloud), expected = brute_force(cloud);
  EXPECT_TRUE(std::includes(now.begin(), now.end(), expected.begin(), expected.end()));
  for (const auto& [first, second] : now) {
    const TetShape a = make_tet_shape(cloud.topology.tet_nodes[at(first)], cloud.nodes.x);
    const TetShape b = make_tet_shape(cloud.topology.tet_nodes[at(second)], cloud.nodes.x);
    const double height = std::min(*std::min_element(a.height.begin(), a.height.end()),
                                   *std::min_element(b.height.begin(), b.height.end()));
    EXPECT_LE(std::max(separation_by_faces(a, b), separation_by_edges(a, b)), 0.03 * height);
  }
}

TEST(BroadPhase, StaysCompleteWhileTheFragmentsTravelWithinTheirMargins) {
  Cloud cloud = make_tet_cloud(150, 4.0, 11);
  const double dt = 0.002;
  cloud.rebuild(dt);
  int steps = 0;
  for (; steps < 200; ++steps) {
    drift(cloud.nodes, dt);
    if (advance_travel(cloud.contact, {cloud.nodes.v, cloud.rigid}, dt)) break;
    cloud.refresh();
    expect_those_and_hardly_parted_ones(cloud);
  }
  EXPECT_GE(steps, 48);
  EXPECT_LT(steps, 200);
}

TEST(BroadPhase, JoinedTetsDoNotTouch) {
  Cloud cloud = make_tet_cloud(2, 0.1, 3);
  cloud.topology.tet_vertices[1][2] = cloud.topology.tet_vertices[0][1];
  const std::vector<FragmentJoint> joint{{cloud.topology.tet_vertices[0][1], {0, 1}}};
  cloud.rebuild(1e-3);
  EXPECT_EQ(cloud.contact.candidates.size(), 1u);
  rebuild_candidates(cloud.contact, {cloud.topology, cloud.nodes, cloud.rigid, joint, 0.05});
  EXPECT_TRUE(cloud.contact.candidates.empty());
}

TEST(ContactImpulses, KeepMomentaAndOnlyDissipate) {
  Cloud cloud = make_tet_cloud(200, 3.5, 5);
  const double dt = 0.002;
  cloud.rebuild(dt);
  for (int step = 0; step < 10; ++step) {
    if (step > 0) advance_travel(cloud.contact, {cloud.nodes.v, cloud.rigid}, dt);
    cloud.refresh();
    ASSERT_GT(cloud.contact.contacts.size(), 30u);
    cloud.nodes.v_before = cloud.nodes.v;
    const Momentum before = momentum(cloud.nodes);
    const double energy = kinetic_energy(cloud.nodes), dissipated = cloud.contact.dissipated;
    apply_contact_impulses(cloud.contact, {cloud.nodes, cloud.rigid}, {.friction = 0.3, .sweeps = 6});
    book_contact_losses(cloud.contact, cloud.nodes, cloud.rigid);
    const Momentum after = momentum(cloud.nodes);
    EXPECT_LT((after.linear - before.linear).norm(), 1e-12);
    EXPECT_LT((after.angular - before.angular).norm(), 1e-11);
    EXPECT_LE(kinetic_energy(cloud.nodes), energy * (1.0 + 1e-12));
    EXPECT_NEAR(cloud.contact.dissipated - dissipated, energy - kinetic_energy(cloud.nodes), 1e-10 * energy);
    drift(cloud.nodes, dt);
  }
}

// Two roofs, one upside down above the other, whose ridges cross: no node of one is ever inside the other.
TetMesh crossed_ridges() {
  return {{Vec3(0, -1, 0), Vec3(0, 1, 0), Vec3(0.6, 0, -1), Vec3(-0.6, 0, -1), Vec3(-1, 0, 0.01), Vec3(1, 0, 0.01),
           Vec3(0, 0.6, 1), Vec3(0, -0.6, 1)},
          {{0, 1, 2, 3}, {4, 5, 6, 7}}};
}

void make_positive(TetMesh& mesh) {
  for (TetCorners& tet : mesh.tets)
    if (tet_volume(mesh.vertices[at(tet[0])], mesh.vertices[at(tet[1])], mesh.vertices[at(tet[2])],
                   mesh.vertices[at(tet[3])]) < 0.0)
      std::swap(tet[0], tet[1]);
}

void let_meet(Cloud& cloud, double dt, int steps, const ContactOptions& options) {
  cloud.rebuild(dt);
  for (int step = 0; step < steps; ++step) {
    drift(cloud.nodes, dt);
    if (advance_travel(cloud.contact, {cloud.nodes.v, cloud.rigid}, dt)) cloud.rebuild(dt);
    cloud.refresh();
    apply_contact_impulses(cloud.contact, {cloud.nodes, cloud.rigid}, options);
  }
}

TEST(ContactImpulses, CrossedEdgesStopEachOther) {
  for (const double sliding : {0.0, 0.3}) {
    TetMesh mesh = crossed_ridges();
    make_positive(mesh);
    Cloud cloud = make_cloud(mesh, {0, 1});
    for (Index i = 4; i < 8; ++i) cloud.nodes.v[at(i)] = padded({sliding, 0.0, -1.0});
    let_meet(cloud, 0.003, 30, {.friction = 0.0});
    ASSERT_EQ(cloud.contact.contacts.size(), 1u);
    // What is common to both moves on, the sliding is untouched: the ridges part along z alone. They meet off their
    // middles by about their depth, 3e-3, and by the way they have slid.
    const auto edge_speed = [&](Index a, Index b, int axis) {
      return 0.5 * (cloud.nodes.v[at(a)][axis] + cloud.nodes.v[at(b)][axis]);
    };
    EXPECT_NEAR(edge_speed(4, 5, 2), -0.5, 2e-3 + 0.01 * sliding);
    EXPECT_NEAR(edge_speed(0, 1, 2), -0.5, 2e-3 + 0.01 * sliding);
    EXPECT_NEAR(edge_speed(4, 5, 0), sliding, 1e-9);
    EXPECT_NEAR(edge_speed(0, 1, 0), 0.0, 1e-9);
  }
}

// Two tets in touch that turn together keep their patch: it turns with them.
TEST(ContactPairs, AKeptPatchTurnsWithItsTets) {
  TetMesh mesh = crossed_ridges();
  make_positive(mesh);
  Cloud cloud = make_cloud(mesh, {0, 1});
  for (Index i = 4; i < 8; ++i) cloud.nodes.v[at(i)] = padded({0.0, 0.0, -1.0});
  let_meet(cloud, 0.003, 30, {.friction = 0.0});
  ASSERT_EQ(cloud.contact.contacts.size(), 1u);
  const Contact before = cloud.contact.contacts[0];
  const Mat3 turn = Eigen::AngleAxisd(0.5, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  for (Vec4& x : cloud.nodes.x) x = padded(turn * xyz(x));
  follow_contacts(cloud.contact, {cloud.topology, cloud.nodes.x, cloud.rigid});
  EXPECT_LT((cloud.contact.contacts[0].place - turn * before.place).norm(), 1e-12);
  EXPECT_EQ(cloud.contact.contacts[0].normal, before.normal);  // until the next look
  cloud.refresh();
  ASSERT_EQ(cloud.contact.contacts.size(), 1u);
  EXPECT_LT((cloud.contact.contacts[0].normal - turn * before.normal).norm(), 1e-12);
  for (std::size_t side = 0; side < 2; ++side)
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_NEAR(cloud.contact.contacts[0].sides[side].weights[k], before.sides[side].weights[k], 1e-12);
}

// A pyramid of four tets about its axis, its tip pointing down into a large tet's flat face.
TEST(ContactImpulses, ATipOfSeveralTetsSlidesFreelyOnAFrictionlessFace) {
  TetMesh mesh{{Vec3(-9, -9, 0), Vec3(9, -9, 0), Vec3(0, 12, 0), Vec3(0, 0, -9), Vec3(0, 0, 0.005), Vec3(1, 1, 1),
                Vec3(-1, 1.2, 1), Vec3(-1, -1, 0.8), Vec3(1.1, -1, 1), Vec3(0, 0, 1)},
               {{0, 2, 1, 3}, {4, 5, 6, 9}, {4, 6, 7, 9}, {4, 7, 8, 9}, {4, 8, 5, 9}}};
  make_positive(mesh);
  Cloud cloud = make_cloud(mesh, {0, 1, 1, 1, 1});
  for (Index i = 4; i < 10; ++i) cloud.nodes.v[at(i)] = padded({0.7, 0.2, -1.0});
  let_meet(cloud, 0.001, 20, {.friction = 0.0, .sweeps = 50});
  ASSERT_GE(cloud.contact.contacts.size(), 4u);
  EXPECT_NEAR(cloud.nodes.v[4].x(), 0.7, 1e-9);
  EXPECT_NEAR(cloud.nodes.v[4].y(), 0.2, 1e-9);
  EXPECT_GT(cloud.nodes.v[4].z(), -0.9);
}

}  // namespace
}  // namespace knap
