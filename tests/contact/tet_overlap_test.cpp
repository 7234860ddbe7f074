#include "contact/tet_overlap.hpp"

#include <gtest/gtest.h>

#include <random>

namespace knap {
namespace {

constexpr unsigned all_faces = 15;

TetShape shape_of(const std::array<Vec3, 4>& corners) {
  const std::vector<Vec4> x{padded(corners[0]), padded(corners[1]), padded(corners[2]), padded(corners[3])};
  return make_tet_shape({0, 1, 2, 3}, x);
}

std::array<Vec3, 4> random_tet(std::mt19937& random, double extent) {
  std::uniform_real_distribution<double> place(-extent, extent);
  std::array<Vec3, 4> corners;
  do {
    for (Vec3& corner : corners) corner = {place(random), place(random), place(random)};
    if (tet_volume(corners[0], corners[1], corners[2], corners[3]) < 0.0) std::swap(corners[0], corners[1]);
  } while (tet_volume(corners[0], corners[1], corners[2], corners[3]) < 0.02);
  return corners;
}

// Volume of the overlap of two tets from samples: independent of any clipping.
double sampled_overlap(const TetShape& a, const TetShape& b, int samples, unsigned seed) {
  std::mt19937 random(seed);
  std::exponential_distribution<double> share(1.0);
  int hits = 0;
  for (int i = 0; i < samples; ++i) {
    std::array<double, 4> w{share(random), share(random), share(random), share(random)};
    const double sum = w[0] + w[1] + w[2] + w[3];
    Vec3 p = Vec3::Zero();
    for (std::size_t k = 0; k < 4; ++k) p += w[k] / sum * a.corners[k];
    const auto lambda = b.coordinates(p);
    hits += std::all_of(lambda.begin(), lambda.end(), [](double l) { return l >= 0.0; });
  }
  return tet_volume(a.corners[0], a.corners[1], a.corners[2], a.corners[3]) * hits / samples;
}

TetShape moved(TetShape shape, const Vec3& by) {
  for (Vec3& corner : shape.corners) corner += by;
  return shape;
}

TEST(OverlapPatch, IsTheGradientOfTheOverlapVolume) {
  std::mt19937 random(3);
  int checked = 0;
  while (checked < 6) {
    const TetShape a = shape_of(random_tet(random, 1.0)), b = shape_of(random_tet(random, 1.0));
    const OverlapPatch patch = overlap_patch(a, all_faces, b, all_faces);
    if (patch.area.norm() < 0.1) continue;
    ++checked;
    // Moving b along the patch's area vector parts the tets: dV = -area . dx.
    const Vec3 step = 0.05 * patch.area.normalized();
    const int samples = 400000;
    const double less = sampled_overlap(a, moved(b, step), samples, 17);
    const double more = sampled_overlap(a, moved(b, -step), samples, 17);
    const double expected = 2.0 * step.norm() * patch.area.norm();
    EXPECT_NEAR(more - less, expected, 0.1 * expected);  // curvature of V over the step, and sampling noise
  }
}

TEST(OverlapPatch, AreasOfBothSidesAreOppositeOverClosedSurfaces) {
  std::mt19937 random(5);
  int overlaps = 0;
  for (int i = 0; i < 400; ++i) {
    const TetShape a = shape_of(random_tet(random, 1.0)), b = shape_of(random_tet(random, 1.0));
    const Vec3 of_a = overlap_patch(a, all_faces, b, 0).area, of_b = overlap_patch(a, 0, b, all_faces).area;
    EXPECT_LT((of_a - of_b).norm(), 1e-13);
    overlaps += of_a.norm() > 1e-6;
  }
  EXPECT_GT(overlaps, 100);
}

TEST(OverlapPatch, CrossedEdgesPartAlongTheirCrossProduct) {
  // An edge along x above, an edge along y below, with wedges of different and uneven flanks.
  const TetShape below = shape_of({Vec3(0, -1, 0), Vec3(0, 1, 0), Vec3(0.5, 0, -1), Vec3(-0.9, 0, -0.7)});
  for (const double depth : {1e-2, 1e-4, 1e-6}) {
    const TetShape above = shape_of({Vec3(-1, 0, -depth), Vec3(1, 0, -depth), Vec3(0, 0.8, 1), Vec3(0, -0.3, 0.9)});
    ASSERT_TRUE(below.is_solid && above.is_solid);
    const OverlapPatch patch = overlap_patch(below, all_faces, above, all_faces);
    EXPECT_GT(patch.size, 0.0);
    EXPECT_LT((patch.area.normalized() - Vec3::UnitZ()).norm(), 1e-8) << "depth " << depth;
    EXPECT_LT(patch.centre.norm(), 3.0 * depth);
  }
}

TEST(OverlapPatch, ACornerPartsAlongTheNormalOfTheFaceItIsIn) {
  const TetShape ground = shape_of({Vec3(-3, -3, 0), Vec3(3, -3, 0), Vec3(0, 5, 0), Vec3(0, 0, -4)});
  const TetShape floor =
      ground.is_solid ? ground : shape_of({Vec3(3, -3, 0), Vec3(-3, -3, 0), Vec3(0, 5, 0), Vec3(0, 0, -4)});
  ASSERT_TRUE(floor.is_solid);
  const TetShape corner = shape_of({Vec3(0.2, 0.1, -1e-3), Vec3(1, 0, 1), Vec3(-0.2, 1, 1), Vec3(-1, -0.5, 0.7)});
  const OverlapPatch patch = overlap_patch(floor, all_faces, corner, all_faces);
  ASSERT_TRUE(corner.is_solid);
  EXPECT_LT((patch.area.normalized() - Vec3::UnitZ()).norm(), 1e-9);
}

// Degenerate touches, swept: faces in one plane, a node on an edge, tets that share an edge or a corner.
TEST(OverlapPatch, DegenerateTouchesAreFiniteAndHaveNoWrongSize) {
  const std::array<Vec3, 4> base{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  const TetShape a = shape_of(base);
  for (const Vec3& shift : {Vec3(0, 0, -1), Vec3(1, 0, 0), Vec3(0.5, 0, 0), Vec3(0, 0.5, 0.5), Vec3(1, 0, -1),
                            Vec3(0, 0, 0), Vec3(1e-17, 0, 0), Vec3(0.25, 0.25, 1e-300)}) {
    const TetShape b = moved(a, shift);
    const TetShape again = shape_of({b.corners[0], b.corners[1], b.corners[2], b.corners[3]});
    const OverlapPatch patch = overlap_patch(a, all_faces, again, all_faces);
    EXPECT_TRUE(std::isfinite(patch.size) && patch.area.allFinite() && patch.centre.allFinite());
    EXPECT_LT(patch.size, 5.0);
  }
}

TEST(Separation, IsNeverMoreThanTheDistance) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-2.0, 2.0);
  int apart = 0, by_edges_only = 0;
  for (int i = 0; i < 3000; ++i) {
    const TetShape a = shape_of(random_tet(random, 1.0));
    auto corners = random_tet(random, 1.0);
    const Vec3 shift(place(random), place(random), place(random));
    for (Vec3& corner : corners) corner += shift;
    const TetShape b = shape_of(corners);
    const double faces = separation_by_faces(a, b), edges = separation_by_edges(a, b);
    double nearest = 1e300;  // an upper bound of the distance: between points of both
    for (int k = 0; k < 200; ++k) {
      std::array<Vec3, 2> p{Vec3::Zero(), Vec3::Zero()};
      for (std::size_t side = 0; side < 2; ++side) {
        double sum = 0.0;
        for (const Vec3& corner : side == 0 ? a.corners : b.corners) {
          const double w = -std::log(std::uniform_real_distribution<double>(1e-12, 1.0)(random));
          p[side] += w * corner;
          sum += w;
        }
        p[side] /= sum;
      }
      nearest = std::min(nearest, (p[0] - p[1]).norm());
    }
    EXPECT_LE(std::max(faces, edges), nearest + 1e-12);
    const bool touches = overlap_patch(a, all_faces, b, all_faces).size > 1e-9;
    EXPECT_EQ(touches, faces == 0.0 && edges == 0.0);
    apart += !touches;
    by_edges_only += faces == 0.0 && edges > 0.0;
  }
  EXPECT_GT(apart, 1000);
  EXPECT_GT(by_edges_only, 20);
}

}  // namespace
}  // namespace knap
