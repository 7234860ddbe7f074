// Particles from mesh files, good and bad.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/app/program.hpp"
#include "tests/support/bar_mesh.hpp"

namespace knap {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string msh2(const TetMesh& mesh) {
  std::string text = fmt::format("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n", mesh.num_vertices());
  for (Index i = 0; i < mesh.num_vertices(); ++i) {
    const Vec3& x = mesh.vertices[at(i)];
    text += fmt::format("{} {} {} {}\n", i + 1, x.x(), x.y(), x.z());
  }
  text += fmt::format("$EndNodes\n$Elements\n{}\n", mesh.num_tets());
  for (Index t = 0; t < mesh.num_tets(); ++t) {
    const auto& [a, b, c, d] = mesh.tets[at(t)];
    text += fmt::format("{} 4 2 1 1 {} {} {} {}\n", t + 1, a + 1, b + 1, c + 1, d + 1);
  }
  return text + "$EndElements\n";
}

class MeshFile : public ProgramTest {
 protected:
  MeshFile() {
    write("case.toml", R"(
[particle]
shape = "mesh_file"
mesh_file = "box.msh"
mesh_scale = "1 mm"
[material]
preset = "zeolite_4ak"
[fracture]
allow_unresolved = true
[impact]
speed = "10 m/s"
[run]
end_time = "1 us"
[output]
frames = 1
picture = false
)");
  }
  TetMesh box = bar_mesh({4, 4, 4}, 0.25);
};

TEST_F(MeshFile, IsScaledPlacedAndRun) {
  write("box.msh", msh2(box));
  const Ended check = run({"check", "case.toml"});
  EXPECT_EQ(check.code, 0) << check.err;
  EXPECT_THAT(check.out, HasSubstr("384 tets"));
  const Ended ended = run({"run", "case.toml", "--out", "r"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(report("r")["mesh"]["tets"], 384);
  EXPECT_EQ(report("r")["mesh"]["nodes"], 125);
  EXPECT_NEAR(report("r")["sanity"]["diameter"], 1.2407e-3, 1e-6);  // the sphere of 1 mm3
}

TEST_F(MeshFile, BadOnesExitWith2AndLeaveNoFolder) {
  const TetMesh good = box;
  std::swap(box.tets[7][0], box.tets[7][1]);
  write("box.msh", msh2(box));
  const Ended inverted = run({"run", "case.toml", "--out", "r"});
  EXPECT_EQ(inverted.code, 2);
  EXPECT_THAT(inverted.err, AllOf(HasSubstr("error: "), HasSubstr("box.msh"), HasSubstr("inverted")));
  EXPECT_FALSE(std::filesystem::exists(folder / "r"));

  box = good;
  box.tets.push_back(box.tets[7]);
  write("box.msh", msh2(box));
  const Ended duplicated = run({"check", "case.toml"});
  EXPECT_EQ(duplicated.code, 2);
  EXPECT_THAT(duplicated.err, HasSubstr("box.msh"));

  write("box.msh", "no mesh at all\n");
  EXPECT_EQ(run({"mesh", "case.toml", "--out", "m.vtu"}).code, 2);
}

TEST_F(MeshFile, MissingOneIsFoundBeforeAnythingElse) {
  const Ended ended = run({"run", "case.toml", "--out", "r"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, AllOf(HasSubstr("particle.mesh_file"), HasSubstr("box.msh")));
}

}  // namespace
}  // namespace knap
