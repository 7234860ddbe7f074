// Particles and tools: what there may be many of.
#include <gmock/gmock.h>

#include <fstream>
#include <numbers>

#include "tests/config/case_text.hpp"

namespace knap {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;
using namespace testing_cases;

// Its lines: 1-4 particle and material, 5 [[tool]], 6 name, 7 type, 8 radius, 9 motion, 10 velocity, 11 [[tool]],
// 12 type, 13 radius, 14 length.
const std::string compression =
    "[particle]\ndiameter = \"2 mm\"\n[material]\npreset = \"zeolite_4ak\"\n"
    "[[tool]]\nname = \"upper\"\ntype = \"platen\"\nradius = \"3 mm\"\nmotion = \"velocity\"\n"
    "velocity = [0, 0, \"-1 m/s\"]\n"
    "[[tool]]\ntype = \"cylinder\"\nradius = 0.001\nlength = 0.004\n";

const std::string two_particles =
    "[[particle]]\nname = \"left\"\ndiameter = \"2 mm\"\nvelocity = [3, 0, 0]\n"
    "[particle.material]\npreset = \"gamma_alumina\"\nyoung_modulus = \"10 GPa\"\n"
    "[[particle]]\ndiameter = \"1 mm\"\nposition = [0.002, 0, 0.001]\nvelocity = [-3, 0, 0]\n"
    "[particle.mesh]\nelement_size = \"0.1 mm\"\n"
    "[mesh]\nelement_size = \"0.2 mm\"\nperturbation = 0.1\n"
    "[material]\npreset = \"zeolite_4ak\"\ndensity = 1300\n";

void expect_round_trip(const RunConfig& config) {
  const std::string text = effective_toml(config);
  const RunConfig again = config_of(text);
  EXPECT_EQ(again, config) << text;
  EXPECT_EQ(effective_toml(again), text);
}

TEST(ToolTables, AreReadWithTheirDefaults) {
  const RunConfig c = config_of(compression);
  ASSERT_EQ(c.tools.size(), 2u);
  EXPECT_EQ(c.tools[0].name, "upper");
  EXPECT_EQ(c.tools[0].type, ToolKind::Platen);
  EXPECT_EQ(c.tools[0].radius, 0.003);
  EXPECT_EQ(c.tools[0].thickness, 0.00075);
  EXPECT_EQ(c.tools[0].normal, Vec3::UnitZ());
  EXPECT_EQ(c.tools[0].motion, MotionKind::Velocity);
  EXPECT_EQ(c.tools[0].velocity, Vec3(0.0, 0.0, -1.0));
  EXPECT_EQ(c.tools[0].friction, 0.3);
  EXPECT_FALSE(c.tools[0].position.has_value());
  EXPECT_EQ(c.tools[1].name, "tool2");
  EXPECT_EQ(c.tools[1].type, ToolKind::Cylinder);
  EXPECT_EQ(c.tools[1].axis, Vec3::UnitY());
  EXPECT_EQ(c.tools[1].motion, MotionKind::Rest);
  EXPECT_EQ(c.impact.speed, 0.0);
  EXPECT_FALSE(has_wall(c));
  EXPECT_TRUE(has_wall(config_of(compression, {"impact.wall=true"})));
  EXPECT_TRUE(has_wall(config_of(shortest)));
}

TEST(ToolTables, OneMayBeWrittenWithSingleBrackets) {
  std::string text = compression.substr(0, compression.find("[[tool]]\ntype = \"cyl"));
  const RunConfig many = config_of(text);
  text.replace(text.find("[[tool]]"), 8, "[tool]");
  EXPECT_EQ(config_of(text), many);
}

TEST(ToolTables, RoundTrip) {
  expect_round_trip(config_of(compression));
  expect_round_trip(
      config_of(compression, {"impact.wall=true", "impact.speed=2 m/s", "tool.upper.motion=ramp",
                              "tool.upper.ramp_time=3 us", "tool.upper.normal=[0, 0.1, -1]", "tool.2.motion=rotation",
                              "tool.2.angular_speed=18000 rpm", "tool.2.rotation_centre=[0.1, 0, 0]",
                              "tool.2.position=[1e-3, 0, -1e-3]", "run.gravity=[0, 0, \"-9.81 m/s2\"]"}));
  expect_round_trip(config_of(compression, {"tool.1.motion=free", "tool.1.mass=5 g"}));
}

TEST(ToolTables, AreOverriddenByNameOrNumber) {
  const RunConfig c =
      config_of(compression, {"tool.upper.friction=0.5", "tool.2.friction=0.1", "tool.tool2.radius=2 mm",
                              "tool.2.motion=rotation", "tool.2.angular_speed=18000 rpm",
                              "tool.2.rotation_centre=[0, 0, 0]", "tool.2.position=[0, 0, -0.01]"});
  EXPECT_EQ(c.tools[0].friction, 0.5);
  EXPECT_EQ(c.tools[1].friction, 0.1);
  EXPECT_EQ(c.tools[1].radius, 0.002);
  EXPECT_DOUBLE_EQ(c.tools[1].angular_speed, 600.0 * std::numbers::pi);
  EXPECT_THAT(complaint(compression, {"tool.friction=1"}),
              StartsWith("command line --set tool.friction=1: there are 2: say which, such as tool.upper.KEY"));
  EXPECT_THAT(complaint(compression, {"tool.lower.friction=1"}),
              HasSubstr("there is no tool \"lower\"; there is upper, tool2"));
  EXPECT_THAT(complaint(compression, {"tool.3.friction=1"}), HasSubstr("there is no tool \"3\""));
  EXPECT_THAT(complaint(compression, {"tool.upper.mesh.friction=1"}), HasSubstr("tool has no part \"mesh\""));
  EXPECT_THAT(complaint(shortest, {"tool.friction=1"}), HasSubstr("there is no [[tool]] in the case"));
}

TEST(ToolTables, MistakesNameLineKeyAndValue) {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = compression;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_THAT(complaint(with("radius = \"3", "radios = \"3")),
              StartsWith("case.toml:8:10: [tool] has no key \"radios\" (did you mean \"radius\"?)"));
  EXPECT_THAT(complaint(with("platen", "plate")), HasSubstr("case.toml:7:8: tool.type = \"plate\": must be one of"));
  EXPECT_THAT(complaint(with("\"3 mm\"", "\"3 s\"")),
              StartsWith("case.toml:8:10: tool.radius = \"3 s\": \"s\" measures"));
  EXPECT_THAT(complaint(with("length = 0.004\n", "")),
              StartsWith("case.toml:11:1: tool.length is missing: Length of the cylinder"));
  EXPECT_THAT(complaint(with("velocity = [0, 0, \"-1 m/s\"]\n", "")),
              HasSubstr("case.toml:5:1: tool.velocity is missing"));
  EXPECT_THAT(complaint(with("radius = 0.001", "radius = 0.001\nnormal = [1, 0, 0]")),
              HasSubstr("case.toml:14:10: tool.normal does not apply: it needs that type = \"plane\" or \"platen\""));
  EXPECT_THAT(complaint(with("\"upper\"", "\"2nd\"")), HasSubstr("tool.name = \"2nd\": must be a word"));
  EXPECT_THAT(complaint(with("\"upper\"", "\"tool2\"")), HasSubstr("is the name of another tool"));
  EXPECT_THAT(complaint(with("\"upper\"", "\"wall\""), {"impact.wall=true"}), HasSubstr("name of another tool"));
  EXPECT_THAT(complaint(with("\"-1 m/s\"", "0")), HasSubstr("write motion = \"rest\""));
  EXPECT_THAT(complaint(with("radius = 0.001", "radius = 0.001\naxis = [0, 0, 0]")), HasSubstr("must point somewhere"));
  EXPECT_THAT(complaint(compression, {"impact.wall_friction=0.1"}), HasSubstr("it needs that there is a wall"));
}

TEST(ParticleTables, FallBackOnWhatIsCommonToAll) {
  const RunConfig c = config_of(two_particles);
  ASSERT_EQ(c.particles.size(), 2u);
  const auto& [left, right] = std::tie(c.particles[0], c.particles[1]);
  EXPECT_EQ(left.name, "left");
  EXPECT_EQ(right.name, "particle2");
  EXPECT_EQ(left.mesh.element_size, 0.2e-3);
  EXPECT_EQ(right.mesh.element_size, 0.1e-3);
  EXPECT_EQ(right.mesh.perturbation, 0.1);
  EXPECT_EQ(left.material.preset, "gamma_alumina");
  EXPECT_EQ(left.material.young_modulus, 10e9);
  EXPECT_EQ(left.material.density, 1470.0);  // its own preset is nearer than the common value
  EXPECT_EQ(right.material.density, 1300.0);
  EXPECT_EQ(right.material.young_modulus, 2.45e9);
  EXPECT_EQ(left.fracture.strength, 17.84e6);
  EXPECT_EQ(right.fracture.strength, 8.34e6);
  EXPECT_EQ(left.velocity.value(), Vec3(3.0, 0.0, 0.0));
  EXPECT_FALSE(left.position.has_value());
  EXPECT_EQ(left.mesh.seed, 0);
  EXPECT_EQ(right.mesh.seed, 1000);
}

TEST(ParticleTables, RoundTrip) {
  expect_round_trip(config_of(two_particles));
  expect_round_trip(config_of(two_particles, {"particle.2.fracture.toughness=0.3 MPa m^1/2", "impact.wall=false"}));
}

TEST(ParticleTables, TheCommandLineWinsOverTheFile) {
  const RunConfig common = config_of(two_particles, {"mesh.element_size=0.15 mm", "material.density=1500"});
  EXPECT_EQ(common.particles[1].mesh.element_size, 0.15e-3);
  EXPECT_EQ(common.particles[0].material.density, 1500.0);
  const RunConfig one =
      config_of(two_particles,
                {"mesh.element_size=0.15 mm", "particle.left.mesh.element_size=0.12 mm", "particle.2.diameter=1.5 mm"});
  EXPECT_EQ(one.particles[0].mesh.element_size, 0.12e-3);
  EXPECT_EQ(one.particles[1].mesh.element_size, 0.15e-3);
  EXPECT_EQ(one.particles[1].diameter, 1.5e-3);
  EXPECT_THAT(complaint(two_particles, {"particle.diameter=1"}), HasSubstr("say which, such as particle.left.KEY"));
}

TEST(ParticleTables, APartOfTheOnlyParticleIsLikeTheCommonSection) {
  const RunConfig own = config_of(shortest + "[particle.mesh]\nelement_size = \"0.2 mm\"\n");
  EXPECT_EQ(own, config_of(shortest, {"mesh.element_size=0.2 mm"}));
  EXPECT_EQ(own, config_of(shortest, {"particle.mesh.element_size=0.2 mm"}));
}

TEST(ParticleTables, MistakesNameLineKeyAndValue) {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = two_particles;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_THAT(complaint(with("[particle.mesh]", "[particle.mash]")),
              StartsWith("case.toml:12:1: [particle] has no key \"mash\""));
  EXPECT_THAT(complaint(with("\"0.1 mm\"", "\"0.1 s\"")), StartsWith("case.toml:13:16: particle.mesh.element_size = "));
  EXPECT_THAT(complaint(with("\"0.1 mm\"", "\"0.9 mm\"")), HasSubstr("particle particle2: mesh.element_size"));
  EXPECT_THAT(complaint(with("diameter = \"1 mm\"\n", "")), HasSubstr("case.toml:8:1: particle.diameter is missing"));
  EXPECT_THAT(complaint(with("velocity = [-3, 0, 0]\n", "")), HasSubstr("impact.speed is missing"));
  EXPECT_THAT(complaint(with("\"left\"", "\"mesh\"")), HasSubstr("is the name of a section"));
  EXPECT_THAT(complaint(with("\"left\"", "\"particle2\"")), HasSubstr("is the name of another particle"));
}

TEST(ParticleTables, ACommonKeyMayBeForOneOfThemAlone) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "knap_common_keys";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "grain.msh") << "$MeshFormat\n";
  const std::string text =
      "[[particle]]\nshape = \"mesh_file\"\nmesh_file = \"" + (folder / "grain.msh").string() +
      "\"\n[[particle]]\ndiameter = 0.002\nposition = [0, 0, 0.01]\n[mesh]\nelement_size = \"0.2 mm\"\n"
      "[material]\npreset = \"plaster\"\n[impact]\nspeed = 3\n";
  EXPECT_EQ(config_of(text).particles[1].mesh.element_size, 0.2e-3);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace knap
