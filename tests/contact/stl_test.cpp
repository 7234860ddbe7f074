#include "contact/read_stl.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <numbers>

#include "contact/repair_surface.hpp"
#include "contact/tool_shape.hpp"
#include "core/errors.hpp"
#include "core/random.hpp"
#include "tests/contact/stl_text.hpp"
#include "tests/support/temporary_folder.hpp"

namespace knap {
namespace {

using testing::HasSubstr;

TriangleSurface surface_of(const Soup& soup) { return repaired_surface(soup, "part.stl"); }
std::string refusal(const Soup& soup) {
  return message_of<InputError>([&] { surface_of(soup); });
}
std::string parse_refusal(const std::string& bytes) {
  return message_of<InputError>([&] { parse_stl(bytes, "part.stl", 1.0); });
}

Soup moved(Soup soup, const Vec3& by) {
  for (auto& triangle : soup)
    for (Vec3& x : triangle) x += by;
  return soup;
}

Soup joined(Soup a, const Soup& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// A ball of radius 1 with 4^levels x 8 triangles.
Soup ball_soup(int levels) {
  Soup soup;
  for (const double x : {1.0, -1.0})
    for (const double y : {1.0, -1.0})
      for (const double z : {1.0, -1.0}) {
        const Vec3 a(x, 0, 0), b(0, y, 0), c(0, 0, z);
        soup.push_back(x * y * z > 0 ? std::array{a, b, c} : std::array{a, c, b});
      }
  for (int level = 0; level < levels; ++level) {
    Soup finer;
    for (const auto& [a, b, c] : soup) {
      const Vec3 ab = (a + b).normalized(), bc = (b + c).normalized(), ca = (c + a).normalized();
      for (const auto& part :
           {std::array{a, ab, ca}, std::array{ab, b, bc}, std::array{ca, bc, c}, std::array{ab, bc, ca}})
        finer.push_back(part);
    }
    soup = std::move(finer);
  }
  return soup;
}

// Signed distance to the unit cube.
double cube_distance(const Vec3& p) {
  const Vec3 beyond = (p - Vec3::Constant(0.5)).cwiseAbs() - Vec3::Constant(0.5);
  return beyond.cwiseMax(0.0).norm() + std::min(0.0, beyond.maxCoeff());
}

TEST(Stl, AsciiAndBinaryAreTheSameSurface) {
  const auto ascii = parse_stl(ascii_stl(cube_soup(2.5)), "a", 1e-3),
             binary = parse_stl(binary_stl(cube_soup(2.5)), "b", 1e-3);
  ASSERT_EQ(ascii.size(), 12u);
  EXPECT_EQ(ascii, binary);
  EXPECT_EQ(ascii[3][2].maxCoeff(), 2.5e-3);
}

TEST(Stl, ReadsWhatOthersWrite) {
  std::string upper = ascii_stl(cube_soup());
  for (char& c : upper) c = static_cast<char>(std::toupper(c));
  EXPECT_EQ(parse_stl(upper, "a", 1.0).size(), 12u);
  EXPECT_EQ(parse_stl(ascii_stl(cube_soup()) + ascii_stl(cube_soup()), "two solids", 1.0).size(), 24u);
  std::string named_solid = binary_stl(cube_soup());
  named_solid.replace(0, 5, "solid");  // some programs write that into binary files
  EXPECT_EQ(parse_stl(named_solid, "a", 1.0).size(), 12u);
}

TEST(Stl, SaysWhatIsWrongAndWhere) {
  EXPECT_THAT(parse_refusal(""), HasSubstr("part.stl: the file is empty"));
  EXPECT_THAT(parse_refusal("PK\x03\x04"), HasSubstr("no STL file"));
  EXPECT_THAT(parse_refusal(std::string(200, 'x')), HasSubstr("no STL file"));
  EXPECT_THAT(parse_refusal("solid\n"), HasSubstr("line 2: the file ends without 'endsolid'"));
  std::string text = ascii_stl(cube_soup());
  text.replace(text.find("vertex"), 8, "vertex x");
  EXPECT_THAT(parse_refusal(text), HasSubstr("line 4: 'x' where a coordinate was expected"));
  Soup soup = cube_soup();
  soup[6][1].y() = std::nan("");
  EXPECT_THAT(parse_refusal(binary_stl(soup)), HasSubstr("triangle 7"));
  EXPECT_THAT(parse_refusal(ascii_stl(soup)), HasSubstr("'nan' where a coordinate"));
  EXPECT_THAT(parse_refusal(binary_stl(cube_soup()) + "x"), HasSubstr("684 bytes, not 685"));
}

TEST(Stl, ARepairedSurfaceIsClosedAndTurnedOutwards) {
  Soup soup = cube_soup();
  for (const std::size_t flipped : {std::size_t{1}, std::size_t{4}, std::size_t{7}})
    std::swap(soup[flipped][0], soup[flipped][1]);
  soup.push_back(soup[2]);                               // twice
  soup.push_back({soup[0][0], soup[0][0], soup[0][1]});  // no extent
  soup[5][0] += Vec3::Constant(1e-8);                    // not quite the same corner
  const TriangleSurface surface = surface_of(soup);
  EXPECT_TRUE(surface.closed);
  EXPECT_EQ(surface.vertices.size(), 8u);
  EXPECT_EQ(surface.triangles.size(), 12u);
  for (auto& triangle : soup) std::swap(triangle[0], triangle[1]);  // inside out
  for (const TriangleSurface& one : {surface, surface_of(soup)}) {
    EXPECT_LT(surface_distance(SurfaceTool{one}, {0.5, 0.5, 0.5}).gap, -0.49);
    EXPECT_GT(surface_distance(SurfaceTool{one}, {1.5, 0.5, 0.5}).gap, 0.49);
  }
}

TEST(Stl, ACavityIsOutside) {
  Soup hollow = cube_soup(3.0);
  const SurfaceTool tool{surface_of(joined(hollow, moved(cube_soup(), Vec3::Constant(1.0))))};
  EXPECT_TRUE(tool.surface.closed);
  EXPECT_NEAR(surface_distance(tool, Vec3::Constant(1.5)).gap, 0.5, 1e-12);
  EXPECT_NEAR(surface_distance(tool, {0.4, 1.5, 1.5}).gap, -0.4, 1e-12);
}

TEST(Stl, WhatCannotBeRepairedIsRefusedByTriangle) {
  EXPECT_THAT(refusal({}), HasSubstr("no triangles"));
  const Vec3 o = Vec3::Zero(), x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  EXPECT_THAT(refusal({{o, o, x}}), HasSubstr("no triangle has any extent"));
  EXPECT_THAT(refusal({{o, x, 2.0 * x}}), HasSubstr("triangle 1 lie on one line"));
  EXPECT_THAT(refusal({{o, x, y}, {o, x, z}, {o, x, -y}}), HasSubstr("triangles 1, 2 and 3 share an edge"));
  EXPECT_THAT(refusal(joined(cube_soup(), moved(cube_soup(), {0.3, 0.4, 0.5}))), HasSubstr("cut each other"));
  EXPECT_THAT(refusal(cube_soup(1e6)), HasSubstr("is its scale right?"));
  EXPECT_THAT(refusal(cube_soup(1e-9)), HasSubstr("is its scale right?"));
  EXPECT_THAT(refusal(moved(cube_soup(), {1e5, 0, 0})), HasSubstr("from the origin"));
  Soup moebius;
  const auto edge = [](int i) {  // of a strip with half a turn in five steps
    const double turn = 2.0 * std::numbers::pi * i / 5, half = 0.5 * turn;
    const Vec3 out(std::cos(turn), std::sin(turn), 0.0);
    const Vec3 along = 0.3 * (std::cos(half) * out + std::sin(half) * Vec3::UnitZ());
    return std::array{Vec3(out - along), Vec3(out + along)};
  };
  for (int i = 0; i < 5; ++i) {
    const auto [a, b] = edge(i);
    const auto [c, d] = edge(i + 1);
    moebius.push_back({a, b, c});
    moebius.push_back({b, d, c});
  }
  EXPECT_THAT(refusal(moebius), HasSubstr("one side only"));
}

TEST(Stl, PartsMayTouchInACorner) {
  const Soup both = joined(cube_soup(), moved(cube_soup(), Vec3::Constant(1.0)));
  const SurfaceTool tool{surface_of(both)};
  EXPECT_TRUE(tool.surface.closed);
  EXPECT_NEAR(surface_distance(tool, Vec3::Constant(0.9)).gap, -0.1, 1e-14);
  EXPECT_NEAR(surface_distance(tool, {0.9, 0.9, 1.1}).gap, 0.1, 1e-14);
}

TEST(Stl, AMissingFileIsNamed) {
  EXPECT_THAT(message_of<InputError>([] { load_stl("no/such.stl", 1.0); }), HasSubstr("no/such.stl"));
}

TEST(SurfaceTool, DistancesToACubeAreExactEverywhere) {
  const SurfaceTool cube{surface_of(cube_soup())};
  std::uint64_t random = 3;
  for (int i = 0; i < 2000; ++i) {
    Vec3 p;
    for (double& coordinate : p) coordinate = 0.5 + 1.2 * uniform_signed(random);
    if (i % 3 == 0) p[i % 9 / 3] = i % 2;                      // in the plane of a side
    if (i % 7 == 0) p = p.cwiseMax(0.0).cwiseMin(1.0).eval();  // on the surface or inside
    const SurfaceDistance distance = surface_distance(cube, p);
    EXPECT_NEAR(distance.gap, cube_distance(p), 1e-14) << p.transpose();
    EXPECT_NEAR(distance.normal.norm(), 1.0, 1e-12);
    const double further = surface_distance(cube, p + 1e-4 * distance.normal).gap;
    if (cube_distance(p) < -0.4) continue;  // near the middle another side may be nearer
    EXPECT_NEAR(further, distance.gap + 1e-4, 1e-10) << p.transpose();
  }
}

// Points beyond an edge or a corner whose nearest faces say inside: only the pseudo-normals know.
TEST(SurfaceTool, KnowsTheSideAtSharpCorners) {
  const Vec3 apex(0, 0, 5);
  const std::array<Vec3, 3> base{Vec3(1, 0, 0), Vec3(-0.5, 0.8, 0), Vec3(-0.5, -0.8, 0)};
  Soup spike{{base[0], base[2], base[1]}};
  for (std::size_t i = 0; i < 3; ++i) spike.push_back({base[i], base[(i + 1) % 3], apex});
  const SurfaceTool tool{surface_of(spike)};
  std::uint64_t random = 5;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 direction = Vec3(uniform_signed(random), uniform_signed(random), uniform_signed(random));
    const Vec3 p = apex + 0.1 * direction;
    bool inside = true;
    for (const auto& [a, b, c] : spike) inside = inside && (b - a).cross(c - a).dot(p - a) < 0.0;
    EXPECT_EQ(surface_distance(tool, p).gap < 0.0, inside) << p.transpose();
  }
}

TEST(SurfaceTool, TheTreeFindsTheNearestOfAll) {
  const SurfaceTool ball{surface_of(ball_soup(4))};
  EXPECT_EQ(ball.surface.triangles.size(), 2048u);
  std::uint64_t random = 11;
  for (int i = 0; i < 30; ++i) {
    const Vec3 p = 2.0 * Vec3(uniform_signed(random), uniform_signed(random), uniform_signed(random));
    double least = 1e300;  // of the distances to each triangle alone
    for (const auto& t : ball.surface.triangles) {
      TriangleSurface one;
      for (const Index vertex : t) one.vertices.push_back(ball.surface.vertices[at(vertex)]);
      one.triangles = {{0, 1, 2}};
      complete_surface(one);
      least = std::min(least, closest_point(one, p).distance);
    }
    const SurfaceDistance distance = surface_distance(ball, p);
    EXPECT_NEAR(std::abs(distance.gap), least, 1e-14);
    EXPECT_NEAR(distance.gap, p.norm() - 1.0, 4e-3);  // the triangles' sagitta
  }
}

TEST(SurfaceTool, AnOpenSurfaceIsAShellOfTwoSides) {
  Soup open = cube_soup();
  open.resize(2);  // the side x = 0
  const SurfaceTool shell{surface_of(open), 0.1};
  EXPECT_FALSE(shell.surface.closed);
  EXPECT_EQ(rim_of(shell.surface).num_edges, 4);
  for (const double side : {1.0, -1.0}) {
    const SurfaceDistance distance = surface_distance(shell, {0.3 * side, 0.4, 0.6});
    EXPECT_NEAR(distance.gap, 0.25, 1e-15);
    EXPECT_NEAR(distance.normal.x(), side, 1e-15);
    EXPECT_NEAR(surface_distance(shell, {0.02 * side, 0.4, 0.6}).gap, -0.03, 1e-15);
  }
  const SurfaceDistance beyond = surface_distance(shell, {0, 1.3, 1.4});
  EXPECT_NEAR(beyond.gap, 0.5 - 0.05, 1e-15);
  EXPECT_NEAR((beyond.normal - Vec3(0, 0.6, 0.8)).norm(), 0.0, 1e-12);
}

}  // namespace
}  // namespace knap
