#include "meshing/reorder.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace knap {
namespace {

// A row of unit cubes of five tets each would not conform; one tet a cell is enough to see the order.
TetMesh scattered_tets() {
  TetMesh mesh;
  for (const int cell : {5, 0, 7, 2, 6, 1, 4, 3}) {
    const Vec3 origin(cell & 1, cell >> 1 & 1, cell >> 2 & 1);
    const Index first = mesh.num_vertices();
    for (const Vec3& x : {Vec3(0, 0, 0), Vec3(0.4, 0, 0), Vec3(0, 0.4, 0), Vec3(0, 0, 0.4)})
      mesh.vertices.push_back(origin + x);
    mesh.vertices.push_back(Vec3(9, 9, 9));  // unused
    mesh.tets.push_back({first, first + 1, first + 2, first + 3});
  }
  return mesh;
}

TEST(MortonOrdered, VisitsOctantsInZOrder) {
  const TetMesh mesh = morton_ordered(scattered_tets());
  ASSERT_EQ(mesh.num_tets(), 8);
  for (Index t = 0; t < 8; ++t) {
    const Vec3 origin = mesh.vertices[at(mesh.tets[at(t)][0])];
    EXPECT_EQ(origin, Vec3(t & 1, t >> 1 & 1, t >> 2 & 1));
  }
}

TEST(MortonOrdered, KeepsTetsAndDropsUnusedVertices) {
  const TetMesh before = scattered_tets();
  const TetMesh mesh = morton_ordered(before);
  EXPECT_EQ(mesh.num_vertices(), 32);
  EXPECT_NEAR(volume(mesh), volume(before), 1e-15);
  for (Index t = 0; t < mesh.num_tets(); ++t) EXPECT_GT(tet_volume(mesh, t), 0.0);
}

TEST(MortonOrdered, DoesNotDependOnTheOrderBefore) {
  TetMesh shuffled = scattered_tets();
  std::reverse(shuffled.tets.begin(), shuffled.tets.end());
  const TetMesh a = morton_ordered(scattered_tets());
  const TetMesh b = morton_ordered(shuffled);
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.tets, b.tets);
}

TEST(MortonOrdered, AnEmptyMeshStaysEmpty) { EXPECT_EQ(morton_ordered({}).num_vertices(), 0); }

}  // namespace
}  // namespace knap
