#include "meshing/shape.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace knap {
namespace {

TEST(Shape, VolumeAndExtentAreThoseOfTheExactShape) {
  EXPECT_DOUBLE_EQ(volume(Sphere{2.0}), 4.0 / 3.0 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(volume(Ellipsoid{{2.0, 4.0, 6.0}}), 4.0 / 3.0 * std::numbers::pi * 6.0);
  EXPECT_DOUBLE_EQ(volume(Box{{1.0, 2.0, 3.0}}), 6.0);
  EXPECT_EQ(extent(Sphere{2.0}), Vec3(2.0, 2.0, 2.0));
  EXPECT_EQ(extent(Ellipsoid{{2.0, 4.0, 6.0}}), Vec3(2.0, 4.0, 6.0));
  EXPECT_EQ(extent(scaled(Box{{1.0, 2.0, 3.0}}, 0.5)), Vec3(0.5, 1.0, 1.5));
}

TEST(Shape, SnappedPointsLieOnTheSurface) {
  const Vec3 x{0.3, -0.5, 0.9};
  EXPECT_NEAR(snapped_to_surface(Sphere{2.0}, x).norm(), 1.0, 1e-15);
  const Vec3 y = snapped_to_surface(Ellipsoid{{2.0, 4.0, 6.0}}, x);
  EXPECT_NEAR(y.cwiseQuotient(Vec3(1.0, 2.0, 3.0)).norm(), 1.0, 1e-15);
}

TEST(Shape, SnappingOnABoxMovesOnlyTheCoordinateOnAFace) {
  const Vec3 x{0.5 + 1e-13, 0.2, -0.1};
  EXPECT_EQ(snapped_to_surface(Box{{1.0, 1.0, 1.0}}, x), Vec3(0.5, 0.2, -0.1));
}

}  // namespace
}  // namespace knap
