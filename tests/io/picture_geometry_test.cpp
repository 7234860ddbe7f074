#include "io/picture_geometry.hpp"

#include <gmock/gmock.h>

#include <numeric>

#include "io/picture_colours.hpp"
#include "tests/io/broken_ball.hpp"

namespace knap {
namespace {

/// Two tets on the facet (0, 1, 2), or broken apart there: the second then has nodes of its own.
PictureInput two_tets(bool broken) {
  PictureInput input;
  input.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -3}};
  input.tets = {{0, 1, 2, 3}, {0, 2, 1, 4}};
  input.fragment_of_tet = {0, broken ? 1 : 0};
  input.fragment_mass = broken ? std::vector<double>{1.0, 3.0} : std::vector<double>{4.0};
  input.damage_of_tet = {0.0, 0.0};
  if (broken) {
    for (Index i = 0; i < 3; ++i) input.points.push_back(input.points[at(i)]);
    input.tets[1] = {5, 7, 6, 4};
    input.broken_facets = {{2, 1, 0}, {5, 6, 7}};
  }
  return input;
}

TEST(PictureGeometry, FacetsBetweenTetsAreInside) {
  const PictureGeometry geometry = make_picture_geometry(two_tets(false));
  EXPECT_EQ(geometry.surface.size(), 6u);
  EXPECT_TRUE(geometry.crack_lines.empty());
  EXPECT_THAT(geometry.is_crack_face, testing::Each(0));
}

TEST(PictureGeometry, CrackLinesRunWhereBrokenFacetsMeetTheSkin) {
  const PictureGeometry geometry = make_picture_geometry(two_tets(true));
  EXPECT_EQ(geometry.surface.size(), 8u);
  EXPECT_EQ(std::accumulate(geometry.is_crack_face.begin(), geometry.is_crack_face.end(), 0), 2);
  using Edge = std::array<Index, 2>;
  EXPECT_THAT(geometry.crack_lines,
              testing::UnorderedElementsAre(Edge{0, 1}, Edge{1, 2}, Edge{0, 2}, Edge{5, 6}, Edge{6, 7}, Edge{5, 7}));
}

TEST(PictureGeometry, SurfaceIsClosedAndPointsOutwards) {
  const PictureInput input = broken_ball(6);
  const PictureGeometry geometry = make_picture_geometry(input);
  Vec3 area = Vec3::Zero();
  double volume = 0.0;
  double tets = 0.0;
  const auto& x = input.points;
  for (const auto& [a, b, c] : geometry.surface) {
    area += (x[at(b)] - x[at(a)]).cross(x[at(c)] - x[at(a)]) / 2.0;
    volume += x[at(a)].cross(x[at(b)]).dot(x[at(c)]) / 6.0;
  }
  for (const auto& [a, b, c, d] : input.tets) {
    tets += (x[at(b)] - x[at(a)]).cross(x[at(c)] - x[at(a)]).dot(x[at(d)] - x[at(a)]) / 6.0;
  }
  EXPECT_LT(area.norm(), 1e-16);  // rounding, against a surface of 1e-5 m2
  EXPECT_NEAR(volume / tets, 1.0, 1e-12);
}

TEST(PictureGeometry, HeaviestFragmentIsFirstAndDustHasNoRank) {
  PictureInput input = two_tets(true);
  EXPECT_THAT(make_picture_geometry(input).fragment_rank, testing::ElementsAre(1, 0));
  input.dust_share = 0.5;
  const PictureGeometry geometry = make_picture_geometry(input);
  EXPECT_THAT(geometry.fragment_rank, testing::ElementsAre(none, 0));
  EXPECT_EQ(geometry.num_main, 1);
  EXPECT_EQ(main_points(input.points, input, geometry).size(), 4u);
}

TEST(PictureGeometry, FragmentsMoveApartAlongTheirCentres) {
  const PictureInput input = two_tets(true);
  const PictureGeometry geometry = make_picture_geometry(input);
  EXPECT_NEAR(geometry.centre.z(), (0.25 * 1.0 - 0.75 * 3.0) / 4.0, 1e-15);
  const std::vector<Vec3> points = exploded_points(input, geometry, 2.0);
  EXPECT_NEAR((points[3] - input.points[3] - Vec3(0, 0, 2.0 * (0.25 + 0.5))).norm(), 0.0, 1e-15);
  EXPECT_NEAR((points[4] - input.points[4] - Vec3(0, 0, 2.0 * (-0.75 + 0.5))).norm(), 0.0, 1e-15);
}

TEST(PictureColours, ScalesEndWhereTheyShould) {
  EXPECT_EQ(damage_colour(-1.0), damage_colour(0.0));
  EXPECT_EQ(damage_colour(2.0), damage_colour(1.0));
  EXPECT_EQ(damage_colour(std::numeric_limits<double>::quiet_NaN()), damage_colour(0.0));
  EXPECT_NE(damage_colour(0.0), damage_colour(1.0));
  EXPECT_EQ(mixed({0, 0, 0}, {255, 100, 10}, 0.5), (Rgb{128, 50, 5}));
  EXPECT_NE(fragment_colour(0), fragment_colour(1));
  EXPECT_EQ(fragment_colour(none), (Rgb{150, 150, 150}));
}

}  // namespace
}  // namespace knap
