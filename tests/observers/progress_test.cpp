#include "observers/progress.hpp"

#include <gmock/gmock.h>

#include "observers/energy_watch.hpp"
#include "tests/observers/breaking_box.hpp"

namespace knap {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST(Progress, LineSaysWhereTheRunIs) {
  const std::string line = progress_line({.time = 12.5e-6,
                                          .end_time = 50e-6,
                                          .end_is_expected = true,
                                          .rate = 812.3,
                                          .time_left = 61.2,
                                          .cracked_area = 3.25e-6,
                                          .fragments = 4,
                                          .closure_error = 1.5e-4});
  EXPECT_EQ(line, " 12.50 / ~50.0 us  25 % | 1:02 left | 812 steps/s | cracks 3.25 mm2 | 4 fragments | ledger 0.015 %");
}

TEST(Progress, UnknownNumbersAreLeftOut) {
  const std::string line = progress_line({.end_time = 1e-6, .time_left = -1.0});
  EXPECT_THAT(line, Not(HasSubstr("left")));
  EXPECT_THAT(line, Not(HasSubstr("steps/s")));
  EXPECT_THAT(line, HasSubstr("| 1 fragment |"));
}

TEST(Progress, TerminalLineIsRewrittenAndFits) {
  std::string shown;
  Simulation s = breaking_box();
  Progress progress({.style = ProgressOptions::Style::Terminal,
                     .end_time = 1e-5,
                     .show = [&shown](const std::string& text) { shown += text; },
                     .width = 40});
  progress.look(s);
  progress.finish(s);
  EXPECT_THAT(shown, StartsWith("\r\x1b[K"));
  EXPECT_EQ(shown.back(), '\n');
  EXPECT_LE(shown.size(), 4u + 39u + 1u);
}

TEST(EnergyWatch, WarnsOnce) {
  std::vector<std::string> warnings;
  EnergyWatch watch([&warnings](const std::string& text) { warnings.push_back(text); });
  Simulation s = breaking_box();
  watch.look(s);
  EXPECT_TRUE(warnings.empty());
  s.ledger.max_closure_error = 0.02;
  watch.look(s);
  watch.look(s);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings.front(), HasSubstr("2.00 %"));
}

TEST(EnergyWatch, WarnsOnceOfAnInvertedTet) {
  std::vector<std::string> warnings;
  EnergyWatch watch([&warnings](const std::string& text) { warnings.push_back(text); });
  Simulation s = breaking_box();
  balance_energies(s);
  watch.look(s);
  EXPECT_TRUE(warnings.empty());
  s.nodes.x[at(s.topology.tet_nodes[0][0])] += Vec4(0.0, 0.0, 1.0, 0.0);  // a metre away: through its own tets
  balance_energies(s);
  EXPECT_LT(s.totals.smallest_volume_ratio, 0.0);
  s.ledger.max_closure_error = 0.0;
  watch.look(s);
  watch.look(s);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings.front(), HasSubstr("inside out"));
}

}  // namespace
}  // namespace knap
