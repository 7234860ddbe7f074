#include "app/case_tools.hpp"

#include <gmock/gmock.h>

#include "config/load_config.hpp"
#include "core/errors.hpp"
#include "tests/support/bar_mesh.hpp"

namespace knap {
namespace {

constexpr double gap = 1e-6;

RunConfig config(const std::string& tools, const std::vector<std::string>& overrides = {}) {
  return config_from_text("[particle]\ndiameter = \"2 mm\"\n[material]\npreset = \"zeolite_4ak\"\n" + tools,
                          "case.toml", overrides);
}

// A cube of 2 mm on the plane z = 0, its centre on the z axis.
TetMesh cube() {
  TetMesh mesh = bar_mesh({4, 4, 4}, 0.5e-3);
  for (Vec3& x : mesh.vertices) x -= Vec3(1e-3, 1e-3, 0.0);
  return mesh;
}

std::vector<ToolOptions> tools(const RunConfig& config) {
  const TetMesh mesh = cube();
  return tool_options(config, std::span(&mesh, 1), gap);
}

ToolOptions only_tool(const std::string& tool) { return tools(config("[[tool]]\n" + tool)).at(0); }

TEST(CaseTools, WithoutATableThereIsTheWall) {
  const auto found = tools(config("[impact]\nspeed = 20\nwall_friction = 0.7\n"));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].name, "wall");
  EXPECT_EQ(found[0].friction, 0.7);
  EXPECT_EQ(found[0].orientation * Vec3::UnitZ(), Vec3::UnitZ());
  EXPECT_TRUE(std::holds_alternative<HalfSpace>(found[0].shape));
}

TEST(CaseTools, TheWallStandsBesideToolsWhereAskedFor) {
  const std::string platen =
      "[[tool]]\nname = \"upper\"\ntype = \"platen\"\nradius = 0.003\nnormal = [0, 0, -2]\n"
      "motion = \"ramp\"\nvelocity = [0, 0, -1]\nramp_time = 1e-5\n";
  EXPECT_EQ(tools(config(platen)).size(), 1u);
  const auto found = tools(config(platen + "[impact]\nwall = true\n"));
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].name, "wall");
  EXPECT_EQ(found[1].name, "upper");
  EXPECT_NEAR((found[1].orientation * Vec3::UnitZ() + Vec3::UnitZ()).norm(), 0.0, 1e-15);
  EXPECT_EQ(std::get<Ramp>(found[1].motion).ramp_time, 1e-5);
  EXPECT_EQ(std::get<DiscPlaten>(found[1].shape).thickness, 0.00075);
}

TEST(CaseTools, ATravellingToolIsPlacedJustAheadOfTheParticle) {
  const ToolOptions platen = only_tool(
      "type = \"platen\"\nradius = 0.003\nnormal = [0, 0, -1]\n"
      "motion = \"velocity\"\nvelocity = [0, 0, -1]\n");
  EXPECT_NEAR((platen.position - Vec3(0, 0, 2e-3 + gap)).norm(), 0.0, 1e-5 * gap);
  // A pin along y that comes from +x touches the face x = 1 mm, at half height.
  const ToolOptions pin = only_tool(
      "type = \"cylinder\"\nradius = 0.003\nlength = 0.01\n"
      "motion = \"velocity\"\nvelocity = [-30, 0, 0]\n");
  EXPECT_NEAR((pin.position - Vec3(4e-3 + gap, 0, 1e-3)).norm(), 0.0, 1e-3 * gap);
  EXPECT_NEAR(std::abs((pin.orientation * Vec3::UnitZ()).y()), 1.0, 1e-15);
  // A ball that rests stands below; its top meets the face z = 0 in the middle, where there is a vertex.
  const ToolOptions ball = tools(config("[[tool]]\ntype = \"sphere\"\nradius = 0.003\n[impact]\nspeed = 3\n")).at(0);
  EXPECT_NEAR((ball.position - Vec3(0, 0, -3e-3 - gap)).norm(), 0.0, 1e-3 * gap);
}

TEST(CaseTools, AGivenPositionIsKept) {
  const ToolOptions pin = only_tool(
      "type = \"sphere\"\nradius = 0.001\nposition = [0.1, 0, 0]\nmotion = \"rotation\"\n"
      "angular_speed = \"60 rpm\"\nrotation_centre = [0, 0, 0]\n");
  EXPECT_EQ(pin.position, Vec3(0.1, 0, 0));
  EXPECT_DOUBLE_EQ(std::get<Rotation>(pin.motion).angular_speed, 2.0 * EIGEN_PI);
}

TEST(CaseTools, AFreeToolIsGuidedAlongItsVelocityOrGravity) {
  const std::string weight =
      "type = \"platen\"\nradius = 0.003\nnormal = [0, 0, -1]\nmotion = \"free\"\nmass = 0.005\n";
  const Guided thrown = std::get<Guided>(only_tool(weight + "velocity = [0, 0, -2]\n").motion);
  EXPECT_EQ(thrown.speed, 2.0);
  EXPECT_EQ(thrown.mass, 0.005);
  EXPECT_EQ(thrown.axis.normalized(), -Vec3::UnitZ());
  const RunConfig falling = config("[[tool]]\n" + weight, {"run.gravity=[0, 0, -9.81]"});
  const Guided dropped = std::get<Guided>(tools(falling).at(0).motion);
  EXPECT_EQ(dropped.speed, 0.0);
  EXPECT_EQ(dropped.axis.normalized(), -Vec3::UnitZ());
}

TEST(CaseTools, AToolThatWouldMissIsRefused) {
  // A thin platen far to the side of the way: its centre is on the way, so only a face that looks away can miss.
  const std::string away =
      "type = \"cylinder\"\nradius = 1e-5\nlength = 1e-5\nmotion = \"velocity\"\nvelocity = [1, 0, 0]\n";
  TetMesh apart = cube();
  for (Vec3& x : apart.vertices) x.y() += x.y() > 0.0 ? 1e-2 : -1e-2;  // nothing in the middle
  try {
    tool_options(config("[[tool]]\n" + away), std::span(&apart, 1), gap);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("tool tool1 would miss the particle"));
  }
}

}  // namespace
}  // namespace knap
