#include "app/simulation_options.hpp"

#include <gtest/gtest.h>

#include "config/load_config.hpp"

namespace knap {
namespace {

RunConfig config(const std::vector<std::string>& overrides) {
  return config_from_text(
      "[particle]\ndiameter = \"2 mm\"\n[material]\npreset = \"zeolite_4ak\"\n[impact]\nspeed = \"20 m/s\"\n",
      "case.toml", overrides);
}

TEST(SimulationOptions, NormalImpactHasExactlyNoTangentialVelocity) {
  EXPECT_EQ(simulation_options(config({})).particles[0].velocity, Vec3(0.0, 0.0, -20.0));
}

TEST(SimulationOptions, AngleIsFromTheWallAndAzimuthFromXTowardsY) {
  const auto oblique = simulation_options(config({"impact.angle=30deg", "impact.azimuth=90deg"}));
  EXPECT_NEAR((oblique.particles[0].velocity - 20.0 * Vec3(0.0, std::sqrt(0.75), -0.5)).norm(), 0.0, 1e-14);
  EXPECT_EQ(oblique.tools.at(0).orientation * Vec3::UnitZ(), Vec3::UnitZ());
}

TEST(SimulationOptions, UnbreakableParticleHasNoFracture) {
  EXPECT_TRUE(simulation_options(config({})).particles[0].fracture.has_value());
  EXPECT_FALSE(simulation_options(config({"fracture.insertion=none"})).particles[0].fracture.has_value());
}

TEST(SimulationOptions, FrictionLawIsPassedOn) {
  const auto blended = simulation_options(config({"fracture.crack_friction=blended", "impact.wall_friction=0.7"}));
  EXPECT_EQ(blended.particles[0].fracture->law.softening_friction, SofteningFriction::Blended);
  EXPECT_EQ(blended.tools.at(0).friction, 0.7);
}

}  // namespace
}  // namespace knap
