#include "io/fragment_surfaces.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "core/errors.hpp"
#include "io/vtk_writer.hpp"
#include "tests/support/temporary_folder.hpp"

namespace knap {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// Two tets above and below the triangle (0,0,0), (1,0,0), (0,1,0), tips at z = 1 and z = -1, with nodes in common.
VtkGrid two_tets(Index upper, Index lower) {
  VtkGrid grid;
  grid.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}};
  grid.tets = {{0, 1, 2, 3}, {0, 2, 1, 4}};
  grid.point_fields = {{"displacement [m]", 3, std::vector<double>(15, 0.0)}};
  grid.cell_int_fields = {{"fragment", 1, {upper, lower}}};
  return grid;
}

// The same with the triangle's nodes split, and the lower one moved down by `gap`.
VtkGrid two_tets_apart(Index upper, Index lower, double gap) {
  VtkGrid grid = two_tets(upper, lower);
  grid.points = {{0, 0, 0},    {1, 0, 0},    {0, 1, 0},    {0, 0, 1},
                 {0, 0, -gap}, {1, 0, -gap}, {0, 1, -gap}, {0, 0, -1 - gap}};
  grid.tets[1] = {4, 6, 5, 7};
  grid.point_fields[0].values.assign(24, 0.0);
  for (std::size_t i = 4; i < 8; ++i) grid.point_fields[0].values[3 * i + 2] = -gap;
  return grid;
}

Vec3 point(const FragmentSurfaces& surfaces, Index i) {
  const auto& x = surfaces.points[at(i)];
  return {x[0], x[1], x[2]};
}

// The surface's area vectors: with normals outwards, x.n dA / 3 sums up to the volume.
struct Outside {
  double area = 0.0, volume = 0.0;
};
Outside outside(const FragmentSurfaces& surfaces, Index fragment) {
  Outside sum;
  for (Index t = surfaces.first_triangle[at(fragment)]; t < surfaces.first_triangle[at(fragment) + 1]; ++t) {
    const auto& [a, b, c] = surfaces.triangles[at(t)];
    const Vec3 x = point(surfaces, a);
    const Vec3 normal = (point(surfaces, b) - x).cross(point(surfaces, c) - x) / 2;
    sum.area += normal.norm();
    sum.volume += x.dot(normal) / 3;
  }
  return sum;
}

const double slanted = std::numbers::sqrt3 / 2;  // area of the facet over the diagonal

class FragmentSurfacesTest : public TemporaryFolder {
 protected:
  FragmentSurfaces read(const VtkGrid& grid) {
    write_vtu(folder / "frame.vtu", grid);
    return read_fragment_surfaces(folder / "frame.vtu");
  }
  std::string complaint() {
    return message_of<InputError>([&] { read_fragment_surfaces(folder / "frame.vtu"); });
  }
};

TEST_F(FragmentSurfacesTest, FacetSharedByTwoTetsOfOneFragmentIsInner) {
  const FragmentSurfaces surfaces = read(two_tets(0, 0));
  ASSERT_EQ(surfaces.num_fragments(), 1);
  EXPECT_EQ(surfaces.triangles.size(), 6u);
  EXPECT_EQ(surfaces.points.size(), 5u);
  EXPECT_THAT(surfaces.is_fracture, testing::Each(0));
  EXPECT_NEAR(outside(surfaces, 0).area, 4 * 0.5 + 2 * slanted, 1e-6);
  EXPECT_NEAR(outside(surfaces, 0).volume, 1.0 / 3, 1e-6);
  EXPECT_NEAR(surfaces.volume[0], 1.0 / 3, 1e-12);
  EXPECT_LT((surfaces.centre[0] - Vec3(0.25, 0.25, 0)).norm(), 1e-12);
}

TEST_F(FragmentSurfacesTest, FacetBetweenTwoFragmentsIsOuterOfBothAndFracture) {
  const FragmentSurfaces surfaces = read(two_tets(0, 1));
  ASSERT_EQ(surfaces.num_fragments(), 2);
  EXPECT_THAT(surfaces.first_triangle, ElementsAre(0, 4, 8));
  EXPECT_THAT(surfaces.first_point, ElementsAre(0, 4, 8)) << "each fragment has its own points";
  for (const Index f : {0, 1}) {
    EXPECT_NEAR(outside(surfaces, f).area, 3 * 0.5 + slanted, 1e-6);
    EXPECT_NEAR(outside(surfaces, f).volume, 1.0 / 6, 1e-6);
    EXPECT_EQ(std::count(surfaces.is_fracture.begin() + 4 * f, surfaces.is_fracture.begin() + 4 * f + 4, 1), 1);
  }
  EXPECT_LT((surfaces.centre[1] - Vec3(0.25, 0.25, -0.25)).norm(), 1e-12);
}

TEST_F(FragmentSurfacesTest, FacesOfAnOpenCrackAreFractureWhetherOrNotItParts) {
  for (const Index lower : {0, 1}) {
    const FragmentSurfaces surfaces = read(two_tets_apart(0, lower, 0.1));
    EXPECT_EQ(surfaces.triangles.size(), 8u);
    EXPECT_EQ(surfaces.points.size(), 8u);
    double crack = 0.0;
    for (std::size_t t = 0; t < 8; ++t) {
      const auto& [a, b, c] = surfaces.triangles[t];
      const Vec3 x = point(surfaces, a);
      if (surfaces.is_fracture[t]) crack += (point(surfaces, b) - x).cross(point(surfaces, c) - x).norm() / 2;
    }
    EXPECT_NEAR(crack, 2 * 0.5, 1e-6);
  }
}

TEST_F(FragmentSurfacesTest, VolumeIsUndeformedAndCentreDeformed) {
  VtkGrid grid = two_tets(0, 0);
  for (std::size_t i = 0; i < 5; ++i) {
    grid.point_fields[0].values[3 * i] = grid.points[i].x();  // twice as wide as it was
    grid.points[i].x() *= 2;
  }
  const FragmentSurfaces surfaces = read(grid);
  EXPECT_NEAR(surfaces.volume[0], 1.0 / 3, 1e-12);
  EXPECT_NEAR(surfaces.centre[0].x(), 0.5, 1e-12);
  EXPECT_NEAR(outside(surfaces, 0).volume, 2.0 / 3, 1e-6);
}

TEST_F(FragmentSurfacesTest, FramesWithoutDisplacementAreRead) {
  VtkGrid grid = two_tets_apart(0, 1, 0.1);
  grid.point_fields.clear();
  const FragmentSurfaces surfaces = read(grid);
  EXPECT_EQ(surfaces.triangles.size(), 8u);
  EXPECT_THAT(surfaces.is_fracture, testing::Each(0));
}

TEST_F(FragmentSurfacesTest, RefusesWhatIsNoFrame) {
  EXPECT_THAT(complaint(), HasSubstr("frame.vtu: cannot be read"));
  std::ofstream(folder / "frame.vtu") << "no XML";
  EXPECT_THAT(complaint(), HasSubstr("frame.vtu: is no complete VTK file"));
  VtkGrid grid = two_tets(0, 0);
  grid.cell_int_fields[0].name = "other";
  write_vtu(folder / "frame.vtu", grid);
  EXPECT_THAT(complaint(), HasSubstr("frame.vtu: has no array 'fragment' on its cells"));
  write_vtu(folder / "frame.vtu", two_tets(0, -1));
  EXPECT_THAT(complaint(), HasSubstr("tet 1: fragment -1 is out of range"));
  write_vtu(folder / "frame.vtu", {});
  EXPECT_THAT(complaint(), HasSubstr("frame.vtu: "));
  grid = two_tets(0, 0);
  grid.triangles = {{0, 1, 2}};
  grid.cell_int_fields[0].values.push_back(0);
  write_vtu(folder / "frame.vtu", grid);
  EXPECT_THAT(complaint(), HasSubstr("cell 2 is no tet"));
}

TEST_F(FragmentSurfacesTest, RefusesATruncatedFile) {
  write_vtu(folder / "whole.vtu", two_tets(0, 1));
  const std::string whole = content(folder / "whole.vtu");
  for (const double share : {0.1, 0.5, 0.9}) {
    std::ofstream(folder / "frame.vtu", std::ios::binary)
        << whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(whole.size())));
    EXPECT_THAT(complaint(), HasSubstr("frame.vtu: ")) << share;
  }
}

TEST(FragmentSurfacesInput, ArraysMustFit) {
  const std::vector<Vec3> points(4, Vec3::Zero());
  const std::vector<TetCorners> tets{{0, 1, 2, 4}};
  const std::vector<Index> fragment{0};
  EXPECT_THROW(make_fragment_surfaces({.points = points, .reference = {}, .tets = tets, .fragment = fragment}),
               std::invalid_argument);
}

}  // namespace
}  // namespace knap
