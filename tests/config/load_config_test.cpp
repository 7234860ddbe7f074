#include "config/load_config.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "tests/config/case_text.hpp"

namespace knap {
namespace {

using testing::HasSubstr;
using namespace testing_cases;

TEST(LoadConfig, FillsEveryDefault) {
  const RunConfig c = config_of(shortest);
  EXPECT_EQ(c.particles[0].shape, ParticleShape::Sphere);
  EXPECT_EQ(c.particles[0].diameter, 0.002);
  EXPECT_EQ(c.particles[0].mesh.seed, 0);
  EXPECT_EQ(c.particles[0].mesh.perturbation, 0.0);
  EXPECT_EQ(c.particles[0].material.viscous_ratio, 0.0);
  EXPECT_EQ(c.particles[0].fracture.insertion, Insertion::Extrinsic);
  EXPECT_EQ(c.particles[0].fracture.mode_ii_ratio, 1.0);
  EXPECT_EQ(c.particles[0].fracture.shear_strength_ratio, 1.5);
  EXPECT_EQ(c.particles[0].fracture.internal_friction, 0.8);
  EXPECT_EQ(c.particles[0].fracture.sliding_friction, 0.1);
  EXPECT_EQ(c.particles[0].fracture.crack_friction, CrackFriction::KeepsConfinedStrength);
  EXPECT_EQ(c.particles[0].fracture.weibull_modulus, 0.0);
  EXPECT_FALSE(c.particles[0].fracture.allow_unresolved);
  EXPECT_EQ(c.impact.angle, std::numbers::pi / 2.0);
  EXPECT_EQ(c.impact.spin, Vec3::Zero());
  EXPECT_EQ(c.impact.wall_friction, 0.3);
  EXPECT_FALSE(c.run.end_time.has_value());
  EXPECT_EQ(c.run, TimeConfig{});
  EXPECT_EQ(c.output, OutputConfig{});
}

TEST(LoadConfig, DerivesTheMeshFromTheParticle) {
  const MeshConfig sphere = config_of(shortest).particles[0].mesh;
  EXPECT_EQ(sphere.element_size, 132e-6);  // (10.9 V/20000)^(1/3) = 131.7 um, three digits
  EXPECT_EQ(sphere.contact_element_size, sphere.element_size);
  EXPECT_EQ(sphere.contact_extent, 0.0005);
  const RunConfig box = config_of(
      "[particle]\nshape = \"box\"\nlengths = [\"1 mm\", 0.002, \"0.3 cm\"]\n[material]\npreset = \"plaster\"\n"
      "[impact]\nspeed = 3\n");
  EXPECT_EQ(box.particles[0].lengths, Vec3(0.001, 0.002, 0.003));
  EXPECT_NEAR(box.particles[0].mesh.element_size, std::cbrt(10.9 * 6e-9 / 20000.0), 5e-7);
  EXPECT_EQ(box.particles[0].mesh.contact_extent, 0.00025);
}

TEST(LoadConfig, PresetsGiveDefaultsThatTheCaseOverrides) {
  const RunConfig zeolite = config_of(shortest);
  EXPECT_EQ(zeolite.particles[0].material.young_modulus, 2.45e9);
  EXPECT_EQ(zeolite.particles[0].material.density, 1270.0);
  EXPECT_EQ(zeolite.particles[0].fracture.strength, 8.34e6);
  EXPECT_EQ(zeolite.particles[0].fracture.fracture_energy, 8.6);
  EXPECT_EQ(zeolite.particles[0].fracture.toughness, 0.0);
  const RunConfig alumina = config_of(shortest, {"material.preset=gamma_alumina", "material.young_modulus=15GPa"});
  EXPECT_EQ(alumina.particles[0].material.young_modulus, 15e9);
  EXPECT_EQ(alumina.particles[0].material.poisson_ratio, 0.3);
  EXPECT_EQ(alumina.particles[0].fracture.strength, 17.84e6);
}

TEST(LoadConfig, ToughnessBecomesFractureEnergy) {
  const RunConfig own = config_of(shortest, {"fracture.toughness=0.3 MPa m^1/2"});
  EXPECT_EQ(own.particles[0].fracture.toughness, 0.3e6);
  EXPECT_DOUBLE_EQ(own.particles[0].fracture.fracture_energy, 0.3e6 * 0.3e6 * (1.0 - 0.0625) / 2.45e9);
  const RunConfig glass = config_of(shortest, {"material.preset=soda_lime_glass"});
  EXPECT_DOUBLE_EQ(glass.particles[0].fracture.fracture_energy, 0.75e6 * 0.75e6 * (1.0 - 0.23 * 0.23) / 71e9);
  const RunConfig energy = config_of(shortest, {"material.preset=soda_lime_glass", "fracture.fracture_energy=5"});
  EXPECT_EQ(energy.particles[0].fracture.fracture_energy, 5.0);
  EXPECT_EQ(energy.particles[0].fracture.toughness, 0.0);
}

TEST(LoadConfig, FractureEnergyAndToughnessTogetherContradict) {
  const std::string both = shortest + "[fracture]\ntoughness = 1e5\nfracture_energy = 5\n";
  EXPECT_THAT(complaint(both),
              HasSubstr("case.toml:8:13: fracture.toughness: give either toughness or fracture_energy"));
  const std::string one = shortest + "[fracture]\nfracture_energy = 5\n";
  EXPECT_EQ(config_of(one, {"fracture.toughness=1e5"}).particles[0].fracture.toughness, 1e5);
}

TEST(LoadConfig, UnbreakableParticlesNeedNoStrength) {
  const std::string bare =
      "[particle]\ndiameter = 0.002\n[material]\nyoung_modulus = 1e9\npoisson_ratio = 0\ndensity = 1000\n"
      "[impact]\nspeed = 5\n";
  const RunConfig elastic = config_of(bare, {"fracture.insertion=none"});
  EXPECT_EQ(elastic.particles[0].fracture.insertion, Insertion::None);
  EXPECT_EQ(elastic.particles[0].fracture.strength, 0.0);
  const std::string text = complaint(bare);
  EXPECT_THAT(text, HasSubstr("fracture.strength is missing"));
  EXPECT_THAT(text, HasSubstr("fracture.fracture_energy is missing"));
}

TEST(LoadConfig, OverridesAcceptTomlAndBareWords) {
  const RunConfig c =
      config_of(shortest, {"impact.speed=30m/s", "impact.angle=45 deg", "run.threads=2",
                           "impact.spin=[0, \"60 rpm\", 1.5]", "fracture.crack_friction=blended",
                           "output.picture=false", "run.end_time=\"20 us\"", " mesh.seed = 7 ", "impact.speed=31"});
  EXPECT_EQ(c.impact.speed, 31.0);  // the last one wins
  EXPECT_DOUBLE_EQ(c.impact.angle, std::numbers::pi / 4.0);
  EXPECT_EQ(c.run.threads, 2);
  EXPECT_DOUBLE_EQ(c.impact.spin[1], 2.0 * std::numbers::pi);
  EXPECT_EQ(c.particles[0].fracture.crack_friction, CrackFriction::Blended);
  EXPECT_FALSE(c.output.picture);
  EXPECT_EQ(c.run.end_time.value(), 20e-6);
  EXPECT_EQ(c.particles[0].mesh.seed, 7);
}

TEST(LoadConfig, SeedsThatAreNotGivenAreTheRunsSeed) {
  EXPECT_EQ(config_of(shortest).particles[0].mesh.seed, 0);
  const RunConfig c = config_of(shortest, {"run.seed=5", "mesh.seed=0"});
  EXPECT_EQ(c.particles[0].mesh.seed, 0);
  EXPECT_EQ(c.particles[0].fracture.weibull_seed, 5);
  EXPECT_EQ(config_of(effective_toml(c)), c);
}

TEST(LoadConfig, DefaultSizesFitThinParticlesAndTheGivenContactSize) {
  std::string without_diameter = shortest;
  without_diameter.erase(without_diameter.find("diameter"), std::string("diameter = \"2 mm\"\n").size());
  const RunConfig thin =
      config_of(without_diameter, {"particle.shape=box", "particle.lengths=[\"10 mm\",\"10 mm\",\"0.1 mm\"]"});
  EXPECT_EQ(thin.particles[0].mesh.element_size, 0.05e-3);
  const RunConfig coarse = config_of(shortest, {"mesh.contact_element_size=0.1 mm"});
  EXPECT_GE(coarse.particles[0].mesh.element_size, 0.1e-3);
}

TEST(LoadConfig, TheMeshFileIsFoundFromTheCaseFolder) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "knap_mesh_file";
  std::filesystem::create_directories(folder / "meshes");
  std::ofstream(folder / "meshes/grain.msh") << "$MeshFormat\n";
  std::ofstream(folder / "case.toml")
      << "[particle]\nshape = \"mesh_file\"\nmesh_file = \"meshes/../meshes/grain.msh\"\n"
         "mesh_scale = \"1 mm\"\n[material]\npreset = \"plaster\"\n[impact]\nspeed = 3\n";
  const RunConfig c = load_config(folder / "case.toml");
  EXPECT_EQ(c.particles[0].mesh_file, (folder / "meshes/grain.msh").lexically_normal());
  EXPECT_EQ(c.particles[0].mesh_scale, 0.001);
  EXPECT_EQ(c.particles[0].mesh.element_size, 0.0);
  EXPECT_EQ(config_of(effective_toml(c)), c);
  const std::vector<std::string> missing{"particle.mesh_file=nothing.msh"}, directory{"particle.mesh_file=meshes"},
      size{"mesh.element_size=1 mm"}, seed{"mesh.seed=1"}, control{"particle.mesh_file=\"a\\nb\""};
  EXPECT_THROW(load_config(folder / "case.toml", missing), InputError);
  EXPECT_THROW(load_config(folder / "case.toml", directory), InputError);
  EXPECT_THROW(load_config(folder / "case.toml", size), InputError);
  EXPECT_THROW(load_config(folder / "case.toml", seed), InputError);
  EXPECT_THROW(load_config(folder / "case.toml", control), InputError);
  std::filesystem::remove_all(folder);
}

TEST(LoadConfig, EveryShippedCaseLoads) {
  int cases = 0;
  for (const auto& file : std::filesystem::directory_iterator(KNAP_SOURCE_DIR "/cases")) {
    if (file.path().extension() != ".toml" || file.path().stem().extension() == ".campaign") continue;
    RunConfig config;
    ASSERT_NO_THROW(config = load_config(file.path())) << file.path();
    EXPECT_EQ(config_of(effective_toml(config)), config) << file.path();
    ++cases;
  }
  EXPECT_GE(cases, 4);
}

}  // namespace
}  // namespace knap
