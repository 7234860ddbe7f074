#include <gtest/gtest.h>

#include <random>
#include <set>

#include "contact/broad_phase.hpp"
#include "contact/contact_impulses.hpp"
#include "contact/contact_pairs.hpp"
#include "contact/free_faces.hpp"
#include "core/nodal_state.hpp"
#include "time/central_difference.hpp"

namespace knap {
namespace {

// A cloud of tets of about unit size that overlap here and there, each a fragment of its own.
TetMesh tet_cloud(Index count, double extent, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(0.0, extent), shape(-0.6, 0.6);
  TetMesh mesh;
  while (mesh.num_tets() < count) {
    const Vec3 centre(place(random), place(random), place(random));
    std::array<Vec3, 4> corners;
    for (Vec3& corner : corners) corner = centre + Vec3(shape(random), shape(random), shape(random));
    const double volume = tet_volume(corners[0], corners[1], corners[2], corners[3]);
    if (std::abs(volume) < 0.01) continue;
    if (volume < 0.0) std::swap(corners[0], corners[1]);
    const Index first = mesh.num_vertices();
    mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
    mesh.tets.push_back({first, first + 1, first + 2, first + 3});
  }
  return mesh;
}

struct Cloud {
  Topology topology;
  NodalState nodes;
  ContactState contact;
  std::vector<std::uint8_t> no_records;
};

Cloud make_cloud(Index count, double extent, unsigned seed) {
  const TetMesh mesh = tet_cloud(count, extent, seed);
  Cloud cloud{make_topology(mesh), {}, {}, std::vector<std::uint8_t>(mesh.vertices.size(), 0)};
  std::mt19937 random(seed + 1);
  std::uniform_real_distribution<double> speed(-1.0, 1.0), mass(0.5, 2.0);
  for (const Vec3& x : mesh.vertices) {
    cloud.nodes.x.push_back(padded(x));
    cloud.nodes.v.push_back(padded({speed(random), speed(random), speed(random)}));
    cloud.nodes.mass.push_back(mass(random));
  }
  cloud.nodes.f = cloud.nodes.v_before = cloud.nodes.v;
  for (Index t = 0; t < mesh.num_tets(); ++t) cloud.contact.fragment_of_tet.push_back(t);
  cloud.contact.fragments = mesh.num_tets();
  cloud.contact.skin = 0.2;
  return cloud;
}

bool is_inside(const Vec3& p, const TetCorners& tet, const std::vector<Vec4>& x) {
  std::array<Vec3, 4> c;
  for (std::size_t i = 0; i < 4; ++i) c[i] = xyz(x[at(tet[i])]);
  return tet_volume(p, c[1], c[2], c[3]) >= 0 && tet_volume(c[0], p, c[2], c[3]) >= 0 &&
         tet_volume(c[0], c[1], p, c[3]) >= 0 && tet_volume(c[0], c[1], c[2], p) >= 0;
}

std::set<std::pair<std::int64_t, Index>> brute_force(const Cloud& cloud) {
  std::set<std::pair<std::int64_t, Index>> pairs;
  const auto points = contact_points(cloud.topology, free_faces(cloud.topology), cloud.contact.fragment_of_tet);
  for (const ContactPoint& point : points)
    for (Index t = 0; t < cloud.topology.num_tets(); ++t)
      if (point.fragment != t &&
          is_inside(position(point, cloud.nodes.x), cloud.topology.tet_nodes[at(t)], cloud.nodes.x))
        pairs.emplace(point.key, t);
  return pairs;
}

std::set<std::pair<std::int64_t, Index>> found(const Cloud& cloud) {
  std::set<std::pair<std::int64_t, Index>> pairs;
  for (const Contact& contact : cloud.contact.contacts) pairs.emplace(contact.point_key, contact.tet);
  return pairs;
}

TEST(BroadPhase, FindsWhatBruteForceFinds) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    Cloud cloud = make_cloud(150, 4.0, seed);
    rebuild_candidates(cloud.contact, cloud.topology, cloud.nodes.x, cloud.no_records);
    refresh_contacts(cloud.contact, cloud.topology, cloud.nodes.x);
    const auto expected = brute_force(cloud);
    EXPECT_GT(expected.size(), 20u);
    EXPECT_EQ(found(cloud), expected);
  }
}

TEST(BroadPhase, StaysCompleteWhileTheBodiesMoveWithinTheSkin) {
  Cloud cloud = make_cloud(150, 4.0, 11);
  rebuild_candidates(cloud.contact, cloud.topology, cloud.nodes.x, cloud.no_records);
  for (int step = 0; step < 12; ++step) {
    drift(cloud.nodes, 0.004);
    cloud.contact.travel += largest_approach(cloud.nodes.v, 0.004);
    ASSERT_LT(cloud.contact.travel, cloud.contact.skin);
    refresh_contacts(cloud.contact, cloud.topology, cloud.nodes.x);
    EXPECT_EQ(found(cloud), brute_force(cloud));
  }
}

TEST(ContactImpulses, KeepMomentaAndOnlyDissipate) {
  Cloud cloud = make_cloud(200, 3.5, 5);
  rebuild_candidates(cloud.contact, cloud.topology, cloud.nodes.x, cloud.no_records);
  for (int step = 0; step < 10; ++step) {
    if (step > 0) cloud.contact.travel += largest_approach(cloud.nodes.v, 0.002);
    refresh_contacts(cloud.contact, cloud.topology, cloud.nodes.x);
    ASSERT_GT(cloud.contact.contacts.size(), 30u);
    cloud.nodes.v_before = cloud.nodes.v;
    const Momentum before = momentum(cloud.nodes);
    const double energy = kinetic_energy(cloud.nodes), dissipated = cloud.contact.dissipated;
    apply_contact_impulses(cloud.contact, cloud.nodes, {.friction = 0.3, .sweeps = 6});
    book_contact_losses(cloud.contact, cloud.nodes);
    const Momentum after = momentum(cloud.nodes);
    EXPECT_LT((after.linear - before.linear).norm(), 1e-12);
    EXPECT_LT((after.angular - before.angular).norm(), 1e-11);
    EXPECT_LE(kinetic_energy(cloud.nodes), energy * (1.0 + 1e-12));
    EXPECT_NEAR(cloud.contact.dissipated - dissipated, energy - kinetic_energy(cloud.nodes), 1e-10 * energy);
    drift(cloud.nodes, 0.002);
  }
}

}  // namespace
}  // namespace knap
