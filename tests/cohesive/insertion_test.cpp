#include "cohesive/insertion.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "simulation/make_simulation.hpp"
#include "tests/support/bar_mesh.hpp"
#include "time/central_difference.hpp"

namespace knap {
namespace {

Simulation block(const std::array<Index, 3>& cells) {
  ParticleOptions particle{.young_modulus = 1e9, .poisson_ratio = 0.2, .density = 1000.0};
  particle.fracture = FractureOptions{.strength = 1e6, .fracture_energy = 10.0};
  particle.velocity = {3.0, -2.0, 1.0};
  particle.spin = {100.0, 50.0, -30.0};
  return make_simulation({.particles = {particle}}, bar_mesh(cells, 1e-3));
}

InsertionOptions insertion_options(const Simulation& s) {
  return {.dt = s.clock.dt,
          .fracture_energy = s.reference.fracture_energy,
          .facet_area = s.reference.facet_area,
          .corner_mass = s.reference.corner_mass,
          .stress = s.elastic.stress};
}

std::vector<OverloadedFacet> open(const std::vector<Index>& facets) {
  std::vector<OverloadedFacet> overloaded;
  for (const Index facet : facets) overloaded.push_back({facet, 1e6, Vec3::Zero()});
  return overloaded;
}

// Facets whose vertices all lie in the plane x = position.
std::vector<Index> facets_in_plane(const Simulation& s, double position) {
  std::vector<Index> facets;
  for (Index f = 0; f < s.topology.num_facets(); ++f) {
    bool inside = true;
    for (int k = 0; k < 3; ++k)
      inside = inside && std::abs(s.reference.vertices[at(s.topology.facet_vertex(f, k))].x() - position) < 1e-9;
    if (inside) facets.push_back(f);
  }
  return facets;
}

TEST(NodeSplit, OneFacetInsideSplitsNothing) {
  Simulation s = block({4, 4, 4});
  Index inside = none;
  for (Index f = 0; f < s.topology.num_facets() && inside == none; ++f) {
    bool interior = true;
    for (int k = 0; k < 3; ++k) {
      const Vec3& x = s.reference.vertices[at(s.topology.facet_vertex(f, k))];
      interior = interior && x.minCoeff() > 0.5e-3 && x.maxCoeff() < 3.5e-3;
    }
    if (interior) inside = f;
  }
  ASSERT_NE(inside, none);
  const Index before = s.nodes.size();
  const auto change = insert_cracks(s.cracks, s.topology, s.nodes, open({inside}), insertion_options(s));
  EXPECT_EQ(s.nodes.size(), before);
  EXPECT_TRUE(change.changed_tets.empty());
  EXPECT_EQ(s.cracks.records.size(), 3u);
  for (const CrackRecord& record : s.cracks.records) EXPECT_TRUE(record.is_closed_tip());
}

TEST(NodeSplit, ACrackThroughTheBlockDoublesTheNodesOfItsPlane) {
  Simulation s = block({4, 3, 2});
  const Index before = s.nodes.size();
  insert_cracks(s.cracks, s.topology, s.nodes, open(facets_in_plane(s, 2e-3)), insertion_options(s));
  EXPECT_EQ(s.nodes.size() - before, 4 * 3);
  for (const CrackRecord& record : s.cracks.records) EXPECT_FALSE(record.is_closed_tip());
}

std::vector<double> masses_of_vertices(const Simulation& s) {
  std::vector<double> masses(at(s.topology.num_vertices()), 0.0);
  for (Index i = 0; i < s.nodes.size(); ++i) masses[at(s.topology.vertex_of_node[at(i)])] += s.nodes.mass[at(i)];
  return masses;
}

// However facets open, in whatever order: the mass of every vertex stays to the last bit, momenta to round-off.
TEST(NodeSplit, KeepsMassMomentumAndEnergy) {
  Simulation s = block({5, 4, 3});
  const Momentum before = momentum(s.nodes);
  const double energy = kinetic_energy(s.nodes);
  const std::vector<double> masses = masses_of_vertices(s);
  std::vector<Index> facets(at(s.topology.num_facets()));
  for (std::size_t i = 0; i < facets.size(); ++i) facets[i] = to_index(i);
  std::mt19937 random(3);
  std::shuffle(facets.begin(), facets.end(), random);
  for (std::size_t first = 0; first < facets.size(); first += 40) {
    std::vector<Index> batch(facets.begin() + static_cast<std::ptrdiff_t>(first),
                             facets.begin() + static_cast<std::ptrdiff_t>(std::min(first + 40, facets.size())));
    std::sort(batch.begin(), batch.end());
    insert_cracks(s.cracks, s.topology, s.nodes, open(batch), insertion_options(s));
    const Momentum now = momentum(s.nodes);
    ASSERT_EQ(masses_of_vertices(s), masses);
    ASSERT_LT((now.linear - before.linear).norm() / before.linear.norm(), 1e-13);
    ASSERT_LT((now.angular - before.angular).norm() / before.angular.norm(), 1e-12);
    ASSERT_NEAR(kinetic_energy(s.nodes) / energy, 1.0, 1e-13);
  }
  // All facets open: every tet has four nodes of its own.
  EXPECT_EQ(s.nodes.size(), 4 * s.topology.num_tets());
  std::set<Index> used;
  for (const auto& tet : s.topology.tet_nodes) used.insert(tet.begin(), tet.end());
  EXPECT_EQ(to_index(used.size()), s.nodes.size());
}

// Mass that scaling has added and booked is not lost when its node splits (again).
TEST(NodeSplit, KeepsMassThatWasAdded) {
  Simulation s = block({4, 2, 2});
  const double before = momentum(s.nodes).mass;
  const double added = 0.5 * s.nodes.mass[0];
  for (double& mass : s.nodes.mass) mass += added;
  const auto count = static_cast<double>(s.nodes.size());
  insert_cracks(s.cracks, s.topology, s.nodes, open(facets_in_plane(s, 2e-3)), insertion_options(s));
  ASSERT_GT(s.nodes.size(), static_cast<Index>(count));
  EXPECT_NEAR(momentum(s.nodes).mass, before + count * added, 1e-12 * before);
}

TEST(NodeSplit, RecordsKnowTheNodesOfBothSides) {
  Simulation s = block({4, 4, 4});
  insert_cracks(s.cracks, s.topology, s.nodes, open(facets_in_plane(s, 1e-3)), insertion_options(s));
  insert_cracks(s.cracks, s.topology, s.nodes, open(facets_in_plane(s, 3e-3)), insertion_options(s));
  for (Index v = 0; v < s.topology.num_vertices(); ++v)
    for (const CrackRecord& record : s.cracks.records_of_vertex(v)) {
      const CrackFace& face = s.cracks.faces[at(record.face)];
      EXPECT_EQ(record.node_a, s.topology.facet_node(face.facet, record.corner, 0));
      EXPECT_EQ(record.node_b, s.topology.facet_node(face.facet, record.corner, 1));
      EXPECT_EQ(s.topology.vertex_of_node[at(record.node_a)], v);
      EXPECT_EQ(s.cracks.face_of_facet[at(face.facet)], record.face);
    }
}

}  // namespace
}  // namespace knap
