#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "core/errors.hpp"
#include "meshing/mesh_quality.hpp"

namespace knap {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

// A cube of edge 1 mm in five tets; the fifth is in the middle.
TetMesh cube() {
  TetMesh mesh{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
               {{0, 1, 3, 4}, {2, 3, 1, 6}, {5, 4, 6, 1}, {7, 6, 4, 3}, {1, 3, 4, 6}}};
  for (Vec3& x : mesh.vertices) x *= 1e-3;
  return mesh;
}

std::string problem_of(const TetMesh& mesh) {
  try {
    check_mesh(mesh, "grain.msh");
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), StartsWith("grain.msh: "));
    return error.what();
  }
  return "none";
}

TEST(CheckMesh, AGoodMeshPasses) { EXPECT_EQ(problem_of(cube()), "none"); }

TEST(CheckMesh, NoTets) { EXPECT_THAT(problem_of({{{0, 0, 0}}, {}}), HasSubstr("no tets")); }

TEST(CheckMesh, AVertexThatDoesNotExist) {
  for (const Index bad : {-1, 8}) {
    TetMesh mesh = cube();
    mesh.tets[3][2] = bad;
    EXPECT_THAT(problem_of(mesh), AllOf(HasSubstr("tet 3"), HasSubstr("does not exist")));
  }
}

TEST(CheckMesh, NonFiniteCoordinates) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    TetMesh mesh = cube();
    mesh.vertices[7].y() = bad;
    EXPECT_THAT(problem_of(mesh), AllOf(HasSubstr("vertex 7 of tet 3"), HasSubstr("not finite")));
  }
}

TEST(CheckMesh, UnusedVerticesDoNotMatter) {
  TetMesh mesh = cube();
  mesh.vertices.push_back(mesh.vertices[0]);
  mesh.vertices.push_back(Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_EQ(problem_of(mesh), "none");
}

TEST(CheckMesh, ARepeatedVertex) {
  TetMesh mesh = cube();
  mesh.tets[2] = {5, 4, 6, 5};
  EXPECT_THAT(problem_of(mesh), AllOf(HasSubstr("tet 2 (vertices 5 4 6 5)"), HasSubstr("same vertex twice")));
}

TEST(CheckMesh, AbsurdSizesHintAtTheScale) {
  for (const double scale : {1e-4, 1e5}) {
    TetMesh mesh = cube();
    for (Vec3& x : mesh.vertices) x *= scale;
    EXPECT_THAT(problem_of(mesh), HasSubstr("mesh_scale"));
  }
}

TEST(CheckMesh, CoincidingVerticesOfACrackedMesh) {
  TetMesh mesh = cube();
  mesh.vertices.push_back(mesh.vertices[1]);
  mesh.tets[0] = {0, 8, 3, 4};
  EXPECT_THAT(problem_of(mesh), AllOf(HasSubstr("vertices 1 and 8"), HasSubstr("merge")));
}

TEST(CheckMesh, AnInvertedTet) {
  TetMesh mesh = cube();
  std::swap(mesh.tets[4][0], mesh.tets[4][1]);
  EXPECT_THAT(problem_of(mesh), AllOf(HasSubstr("tet 4 (vertices 3 1 4 6) is inverted"), HasSubstr("volume -3.3")));
}

TEST(CheckMesh, FlatTetsAreCounted) {
  TetMesh mesh = cube();
  mesh.tets[0] = {0, 1, 2, 3};
  mesh.tets[3] = {4, 5, 6, 7};
  EXPECT_THAT(problem_of(mesh), AllOf(HasSubstr("tet 0 (vertices 0 1 2 3) is flat"), HasSubstr("2 such tets")));
}

TEST(CheckMesh, ADuplicatedTet) {
  TetMesh mesh = cube();
  mesh.tets.push_back({3, 4, 0, 1});
  EXPECT_THAT(problem_of(mesh), AllOf(HasSubstr("tet 0 (vertices 0 1 3 4)"), HasSubstr("tet 5 are the same")));
}

TEST(CheckMesh, AFacetOfThreeTets) {
  TetMesh mesh = cube();
  mesh.vertices.push_back({-1e-3, -1e-3, -1e-3});
  mesh.tets.push_back({1, 3, 4, 8});
  if (tet_volume(mesh, 5) < 0.0) std::swap(mesh.tets[5][0], mesh.tets[5][1]);
  EXPECT_THAT(problem_of(mesh), AllOf(HasSubstr("vertices 1 3 4 is shared by more than two tets: 0, 4, 5")));
}

TEST(CheckMesh, TetsOnTheSameSideOfAFacet) {
  TetMesh mesh = cube();
  mesh.tets = {mesh.tets[0]};
  mesh.vertices.push_back({0.2e-3, 0.2e-3, 0.5e-3});
  mesh.tets.push_back({0, 1, 3, 8});
  ASSERT_GT(tet_volume(mesh, 1), 0.0);
  EXPECT_THAT(problem_of(mesh), AllOf(HasSubstr("same side"), HasSubstr("overlap")));
}

TEST(CheckMesh, PartsThatMeetInAnEdgeOnlyAreNotOnePiece) {
  TetMesh mesh = cube();
  mesh.tets.pop_back();  // the corners of the cube share edges, no facets
  EXPECT_THAT(problem_of(mesh), AllOf(HasSubstr("4 parts"), HasSubstr("1 tets with tet 0, 1 tets with tet 1")));
}

}  // namespace
}  // namespace knap
