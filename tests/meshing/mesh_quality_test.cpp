#include "meshing/mesh_quality.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace knap {
namespace {

// Edge 2 sqrt(2).
TetMesh regular_tet() { return {{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {{0, 2, 1, 3}}}; }

TEST(MeshQuality, ARegularTetIsPerfect) {
  const double edge = 2.0 * std::numbers::sqrt2;
  const MeshQuality quality = measure_quality(regular_tet());
  EXPECT_EQ(quality.num_tets, 1);
  EXPECT_EQ(quality.num_vertices, 4);
  EXPECT_NEAR(quality.min_shape, 1.0, 1e-14);
  EXPECT_NEAR(quality.mean_shape, 1.0, 1e-14);
  EXPECT_NEAR(quality.min_dihedral, std::acos(1.0 / 3.0), 1e-14);
  EXPECT_NEAR(quality.min_altitude, edge * std::sqrt(2.0 / 3.0), 1e-14);
  EXPECT_NEAR(quality.min_edge, edge, 1e-14);
  EXPECT_NEAR(quality.mean_edge, edge, 1e-14);
  EXPECT_NEAR(quality.max_edge, edge, 1e-14);
  EXPECT_NEAR(quality.total_volume, edge * edge * edge / (6.0 * std::numbers::sqrt2), 1e-13);
}

TEST(MeshQuality, ShapeIsNegativeWhenInvertedZeroWhenFlatAndKeepsUnderScaling) {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  const double shape = shape_quality(a, b, c, {0.3, 0.2, 0.1});
  EXPECT_GT(shape, 0.0);
  EXPECT_NEAR(shape_quality(a, c, b, {0.3, 0.2, 0.1}), -shape, 1e-15);
  EXPECT_NEAR(shape_quality(1e-6 * a, 1e-6 * b, 1e-6 * c, 1e-6 * Vec3(0.3, 0.2, 0.1)), shape, 1e-14);
  EXPECT_EQ(shape_quality(a, b, c, {0.3, 0.2, 0.0}), 0.0);
}

TEST(MeshQuality, ASliverHasASmallDihedralAngle) {
  const TetMesh sliver{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0.01}, {0, -1, 0.01}}, {{0, 1, 2, 3}}};
  ASSERT_NE(tet_volume(sliver, 0), 0.0);
  const TetMesh positive{sliver.vertices,
                         {tet_volume(sliver, 0) > 0 ? TetCorners{0, 1, 2, 3} : TetCorners{1, 0, 2, 3}}};
  const MeshQuality quality = measure_quality(positive);
  // Normals (0, 0.01, -1) and (0.01, 0, 1) at the four short edges.
  EXPECT_NEAR(quality.min_dihedral, std::acos(1.0 / 1.0001), 1e-12);
  EXPECT_LT(quality.min_shape, 0.05);
}

TEST(MeshQuality, AnEmptyMeshMeasuresZero) {
  EXPECT_EQ(measure_quality({}).num_tets, 0);
  EXPECT_EQ(measure_quality({}).min_edge, 0.0);
}

}  // namespace
}  // namespace knap
