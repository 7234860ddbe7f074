// [quasistatic]: which cases can start at the onset of fracture, and what the others are told.
#include <gmock/gmock.h>

#include "tests/config/case_text.hpp"
#include "tests/support/pressed_case.hpp"

namespace knap {
namespace {

using testing::HasSubstr;
using namespace testing_cases;

const std::string pressed = pressed_case(from_the_onset);

TEST(QuasistaticCase, IsTakenWithTwoFlatToolsThatComeNearer) {
  const RunConfig config = config_of(pressed);
  EXPECT_TRUE(config.quasistatic.enabled);
  EXPECT_DOUBLE_EQ(config.quasistatic.onset_tolerance, 1e-3);
  EXPECT_DOUBLE_EQ(config.quasistatic.largest_approach, 0.25);
  EXPECT_EQ(config_of(effective_toml(config)), config);
  EXPECT_NO_THROW(config_of(pressed, {"tool.upper.motion=ramp", "tool.upper.ramp_time=1us"}));
}

TEST(QuasistaticCase, RefusesToolsThatDoNotPress) {
  const auto told = [](const std::vector<std::string>& overrides) { return complaint(pressed, overrides); };
  EXPECT_THAT(told({"impact.wall=false"}), HasSubstr("quasistatic.enabled = true: needs the particle between two flat "
                                                     "tools, two [[tool]] or impact.wall = true and one [[tool]]; the "
                                                     "case has 1"));
  EXPECT_THAT(told({"tool.upper.normal=[0,0,1]"}), HasSubstr("the two tools must face each other"));
  EXPECT_THAT(told({"tool.upper.velocity=[0,0,1]"}), HasSubstr("must come nearer to each other"));
  EXPECT_THAT(told({"tool.upper.velocity=[0.1,0,-1]"}),
              HasSubstr("tool.velocity: must be along tool.normal when quasistatic.enabled = true (tool upper)"));
  EXPECT_THAT(told({"tool.upper.motion=free", "tool.upper.mass=1"}),
              HasSubstr("needs tools with motion = \"rest\", \"velocity\" or \"ramp\" (tool upper)"));
  std::string ball = pressed;
  ball.replace(ball.find("\"platen\""), 8, "\"sphere\"");
  ball.erase(ball.find("normal"), std::string("normal = [0, 0, -1]\n").size());
  EXPECT_THAT(complaint(ball), HasSubstr("type = \"plane\" or \"platen\" (tool upper)"));
}

TEST(QuasistaticCase, RefusesWhatIsNotAtRestOrCannotBreak) {
  const auto told = [](const std::vector<std::string>& overrides) { return complaint(pressed, overrides); };
  EXPECT_THAT(told({"run.gravity=[0,0,-9.81]"}), HasSubstr("run.gravity: must be [0, 0, 0]"));
  EXPECT_THAT(told({"impact.speed=1"}), HasSubstr("impact.speed: the particle must be at rest"));
  EXPECT_THAT(told({"particle.velocity=[0,0,-1]"}), HasSubstr("particle.velocity: the particle must be at rest"));
  EXPECT_THAT(told({"impact.spin=[0,0,1]"}), HasSubstr("impact.spin: the particle must be at rest"));
  EXPECT_THAT(told({"particle.spin=[0,0,1]"}), HasSubstr("particle.spin: the particle must be at rest"));
  EXPECT_THAT(told({"fracture.insertion=none"}), HasSubstr("fracture.insertion = \"none\""));
  EXPECT_THAT(complaint(pressed + "[[particle]]\ndiameter = 0.001\n"), HasSubstr("particle"));
  EXPECT_THAT(told({"quasistatic.enabled=false", "quasistatic.largest_approach=0.1"}),
              HasSubstr("does not apply: it needs that enabled = true"));
}

TEST(QuasistaticCase, FlatToolsBelowAndAboveMakeTwoContacts) {
  const auto on_top = [](const std::vector<std::string>& overrides) {
    return config_of(pressed, overrides).particles[0].mesh.contact_on_top.value();
  };
  EXPECT_TRUE(on_top({}));
  EXPECT_FALSE(on_top({"mesh.contact_on_top=false"}));
  EXPECT_FALSE(on_top({"quasistatic.enabled=false", "impact.wall=false"}));
  EXPECT_FALSE(config_of(shortest).particles[0].mesh.contact_on_top.value());
  EXPECT_TRUE(config_of(shortest, {"mesh.contact_on_top=true"}).particles[0].mesh.contact_on_top.value());
}

}  // namespace
}  // namespace knap
