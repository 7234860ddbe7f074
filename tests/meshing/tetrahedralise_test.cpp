#include "meshing/tetrahedralise.hpp"

#include <gtest/gtest.h>

namespace knap {
namespace {

TEST(Tetrahedralise, SphereHasItsVolumeAndItsVerticesOnTheSurface) {
  const Sphere sphere{2e-3};
  const TetMesh mesh = tetrahedralise(sphere, {.element_size = 0.2e-3});
  EXPECT_LT(volume(mesh), volume(sphere));
  EXPECT_GT(volume(mesh), 0.98 * volume(sphere));
  EXPECT_NEAR(mean_edge(mesh), 0.2e-3, 0.02e-3);
  for (Index t = 0; t < mesh.num_tets(); ++t) ASSERT_GT(tet_volume(mesh, t), 0.0);
}

}  // namespace
}  // namespace knap
