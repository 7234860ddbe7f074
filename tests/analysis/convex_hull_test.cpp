#include "analysis/convex_hull.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <random>

namespace knap {
namespace {

std::vector<Vec3> grid_points() {
  std::vector<Vec3> points;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 4; ++k) points.emplace_back(0.1 * i, 0.3 * j, 0.7 * k);
  return points;
}

/// Slanted faces that are exactly flat.
std::vector<Vec3> sheared_grid_points() {
  std::vector<Vec3> points;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 4; ++k) points.emplace_back(1.0 / 1024.0 * Vec3(i + 2 * j, j + 3 * k, k + 5 * i));
  return points;
}

std::vector<Vec3> ball_points() {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  std::vector<Vec3> points;
  for (int i = 0; i < 300; ++i)
    points.push_back(1e-3 * Vec3(normal(random), normal(random), normal(random)).normalized());
  return points;
}

/// The points in another order, with other blocks of memory in between.
double volume_again(std::vector<Vec3> points, std::mt19937& random) {
  std::shuffle(points.begin(), points.end(), random);
  std::vector<std::unique_ptr<char[]>> blocks;
  for (int i = 0; i < 200; ++i) blocks.push_back(std::make_unique<char[]>(16 + random() % 4000));
  std::shuffle(blocks.begin(), blocks.end(), random);
  blocks.resize(100);
  return convex_hull(points).volume;
}

// Its faces come in an order that the addresses of memory decide, and flat parts in triangles that the order of the
// points decides.
TEST(ConvexHull, VolumeHasTheSameBitsInAnyOrderOfPointsAndMemory) {
  for (const auto& points : {grid_points(), sheared_grid_points(), ball_points()}) {
    const double volume = convex_hull(points).volume;
    EXPECT_GT(volume, 0.0);
    std::mt19937 random(1);
    for (int i = 0; i < 200; ++i) ASSERT_EQ(volume_again(points, random), volume) << i;
  }
}

TEST(ConvexHull, OfABoxHasItsVolume) { EXPECT_NEAR(convex_hull(grid_points()).volume, 0.3 * 0.9 * 2.1, 1e-15); }

}  // namespace
}  // namespace knap
