#include "core/topology.hpp"

#include <gtest/gtest.h>

#include "core/errors.hpp"

namespace knap {
namespace {

TetMesh two_tets() { return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}, {{0, 1, 2, 3}, {1, 2, 3, 4}}}; }

TEST(Topology, FacetNormalPointsFromMinusToPlus) {
  const TetMesh mesh = two_tets();
  ASSERT_GT(tet_volume(mesh, 0), 0.0);
  ASSERT_GT(tet_volume(mesh, 1), 0.0);
  const Topology topology = make_topology(mesh);
  ASSERT_EQ(topology.num_facets(), 1);
  EXPECT_EQ(topology.outer_facets.size(), 6u);
  const Vec3 a = mesh.vertices[at(topology.facet_node(0, 0, 0))];
  const Vec3 b = mesh.vertices[at(topology.facet_node(0, 1, 0))];
  const Vec3 c = mesh.vertices[at(topology.facet_node(0, 2, 0))];
  EXPECT_GT((b - a).cross(c - a).dot(mesh.vertices[4] - a), 0.0);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(topology.facet_node(0, k, 0), topology.facet_node(0, k, 1));
}

TEST(Topology, ThreeTetsOnOneFacetAreRefused) {
  TetMesh mesh = two_tets();
  mesh.vertices.push_back({2, 2, 2});
  mesh.tets.push_back({1, 2, 3, 5});
  EXPECT_THROW(make_topology(mesh), InputError);
}

}  // namespace
}  // namespace knap
