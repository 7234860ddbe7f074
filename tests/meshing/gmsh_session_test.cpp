#include "meshing/gmsh_session.hpp"

#include <gmock/gmock.h>
#include <gmsh.h>
#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "meshing/tetrahedralise.hpp"

namespace knap {
namespace {

std::string failure_of(const std::function<void()>& work) {
  try {
    with_gmsh(work);
  } catch (const RuntimeFailure& failure) {
    return failure.what();
  }
  return "none";
}

// In gmsh 4.8 such an error is raised inside an OpenMP loop: as an exception it would end the process.
void mesh_with_a_broken_size() {
  gmsh::model::occ::addBox(0, 0, 0, 1, 1, 1);
  gmsh::model::occ::synchronize();
  const int field = gmsh::model::mesh::field::add("MathEval");
  gmsh::model::mesh::field::setString(field, "F", "nonsense(");
  gmsh::model::mesh::field::setAsBackgroundMesh(field);
  generate_mesh(2);
}

TEST(GmshSession, GmshsErrorsBecomeFailuresWithItsMessage) {
  EXPECT_THAT(failure_of(mesh_with_a_broken_size), testing::HasSubstr("gmsh failed: "));
}

TEST(GmshSession, MeshingWorksAfterAFailure) {
  const TetrahedraliseOptions options{.element_size = 0.3};
  const TetMesh before = tetrahedralise(Sphere{1.0}, options);
  failure_of(mesh_with_a_broken_size);
  EXPECT_THROW(with_gmsh([] { throw InputError("ours"); }), InputError);
  const TetMesh after = tetrahedralise(Sphere{1.0}, options);
  EXPECT_EQ(before.vertices, after.vertices);
  EXPECT_EQ(before.tets, after.tets);
}

TEST(GmshSession, LeavesNoModelBehind) {
  std::vector<std::string> before, after;
  with_gmsh([] {});
  gmsh::model::list(before);
  for (int i = 0; i < 3; ++i) tetrahedralise(Box{{1.0, 1.0, 1.0}}, {.element_size = 0.5});
  gmsh::model::list(after);
  EXPECT_EQ(before, after);
}

}  // namespace
}  // namespace knap
