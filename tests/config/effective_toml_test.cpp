#include <gmock/gmock.h>

#include <cmath>

#include "config/material_presets.hpp"
#include "config/schema.hpp"
#include "tests/config/case_text.hpp"

namespace knap {
namespace {

using testing::HasSubstr;
using namespace testing_cases;

void expect_round_trip(const RunConfig& config) {
  const std::string text = effective_toml(config);
  const RunConfig again = config_of(text);
  EXPECT_EQ(again, config) << text;
  EXPECT_EQ(effective_toml(again), text);
}

TEST(EffectiveToml, RoundTripsBitForBit) {
  expect_round_trip(config_of(shortest));
  expect_round_trip(config_of(
      shortest,
      {"particle.diameter=1.0000000000000002 mm", "mesh.element_size=0.0000912345678901234567", "mesh.perturbation=0.1",
       "material.viscous_ratio=0.3", "material.relaxation_time=2 us", "fracture.toughness=0.212345678 MPa m^1/2",
       "fracture.crushed_zone_facets=2.5", "fracture.weibull_modulus=7.7", "fracture.weibull_reference_volume=0.33 mm3",
       "fracture.crack_friction=blended", "impact.angle=33.3 deg", "impact.azimuth=-17 deg",
       "impact.spin=[\"1 rpm\", -0.1, 1e7]", "run.end_time=17.77 us", "run.seed=999999999999999",
       "output.history_interval=33 ns", "output.picture=false"}));
}

TEST(EffectiveToml, KeepsTheSignOfZero) {
  const RunConfig again = config_of(effective_toml(config_of(shortest, {"impact.spin=[-0.0, 0.0, 0]"})));
  EXPECT_TRUE(std::signbit(again.impact.spin[0]));
  EXPECT_FALSE(std::signbit(again.impact.spin[1]));
}

TEST(EffectiveToml, RoundTripsEveryShapeAndPreset) {
  const std::string end = "[material]\npreset = \"plaster\"\n[impact]\nspeed = 3\n";
  expect_round_trip(config_of("[particle]\nshape = \"box\"\nlengths = [0.1, 0.2, 0.3]\n" + end));
  expect_round_trip(config_of("[particle]\nshape = \"ellipsoid\"\ndiameters = [0.1, 0.2, 0.3]\n" + end));
  for (const auto& name : preset_names()) {
    expect_round_trip(config_of(shortest, {"material.preset=" + name}));
    expect_round_trip(config_of(shortest, {"material.preset=" + name, "fracture.fracture_energy=1.1"}));
    expect_round_trip(config_of(shortest, {"material.preset=" + name, "fracture.toughness=1.1e5"}));
  }
  expect_round_trip(config_of(
      "[particle]\ndiameter = 1\n[material]\nyoung_modulus = 1e9\npoisson_ratio = 0\ndensity = 1e3\n[fracture]\n"
      "insertion = \"none\"\n[impact]\nspeed = 3\nwall_friction = 0\n"));
}

TEST(EffectiveToml, GivesAUnitForEachKey) {
  const std::string text = effective_toml(config_of(shortest));
  EXPECT_THAT(text, HasSubstr("\nspeed = 15.0  # [m/s] Speed of the particle"));
  EXPECT_THAT(text, HasSubstr("\nangle = 1.5707963267948966  # [rad] "));
  EXPECT_THAT(text, HasSubstr("\n# end_time: automatic"));
}

TEST(EffectiveToml, QuotesOddPaths) {
  RunConfig config = config_of(shortest);
  config.particles[0].shape = ParticleShape::MeshFile;
  config.particles[0].mesh_file = "/data/a \"b\"\\c\n\u00fc.msh";
  EXPECT_THAT(effective_toml(config), HasSubstr("mesh_file = \"/data/a \\\"b\\\"\\\\c\\u000A\u00fc.msh\""));
}

}  // namespace
}  // namespace knap
