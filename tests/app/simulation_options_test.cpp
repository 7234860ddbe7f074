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
}

TEST(SimulationOptions, UnbreakableParticleHasNoFracture) {
  EXPECT_TRUE(simulation_options(config({})).particles[0].fracture.has_value());
  EXPECT_FALSE(simulation_options(config({"fracture.insertion=none"})).particles[0].fracture.has_value());
}

TEST(SimulationOptions, FrictionLawIsPassedOn) {
  const auto blended = simulation_options(config({"fracture.crack_friction=blended"}));
  EXPECT_EQ(blended.particles[0].fracture->law.softening_friction, SofteningFriction::Blended);
}

TEST(SimulationOptions, EachParticleHasItsOwn) {
  const SimulationOptions two = simulation_options(
      config_from_text("[[particle]]\ndiameter = 0.002\n[[particle]]\ndiameter = 0.001\nposition = [0, 0, 0.01]\n"
                       "velocity = [0, 0, -7]\n[particle.material]\npreset = \"gamma_alumina\"\n[particle.fracture]\n"
                       "insertion = \"none\"\n[material]\npreset = \"zeolite_4ak\"\n[impact]\nspeed = 20\n[run]\n"
                       "gravity = [0, 0, -9.81]\n",
                       "case.toml"));
  ASSERT_EQ(two.particles.size(), 2u);
  EXPECT_EQ(two.particles[0].velocity, Vec3(0, 0, -20));
  EXPECT_EQ(two.particles[1].velocity, Vec3(0, 0, -7));
  EXPECT_EQ(two.particles[0].density, 1270.0);
  EXPECT_EQ(two.particles[1].density, 1470.0);
  EXPECT_TRUE(two.particles[0].fracture.has_value());
  EXPECT_FALSE(two.particles[1].fracture.has_value());
  EXPECT_EQ(two.gravity, Vec3(0, 0, -9.81));
}

TEST(SimulationOptions, RigidFragmentsArePassedOn) {
  EXPECT_FALSE(simulation_options(config({})).rigid_fragments.enabled);
  const SimulationOptions rigid = simulation_options(
      config({"contact.rigid_fragments=true", "contact.restitution=0.6", "contact.wake_at_load_share=0.2"}));
  EXPECT_TRUE(rigid.rigid_fragments.enabled);
  EXPECT_EQ(rigid.restitution, 0.6);
  EXPECT_EQ(rigid.rigid_fragments.load_share, 0.2);
  EXPECT_EQ(rigid.rigid_fragments.quiet_crossings, RigidFragmentOptions{}.quiet_crossings);
}

}  // namespace
}  // namespace knap
