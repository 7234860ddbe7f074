#include "app/summary.hpp"

#include <gmock/gmock.h>

#include <limits>

namespace knap {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

Simulation finished() {
  Simulation s;
  s.reference.incident_energy = 2e-3;
  s.ledger[EnergyTerm::Kinetic] = 1e-3;
  return s;
}

RunOutcome in_pieces(Index count) {
  RunOutcome outcome;
  outcome.damage.measures.count = outcome.strict.measures.count = count;
  outcome.rebound.tangential = std::numeric_limits<double>::quiet_NaN();
  return outcome;
}

TEST(Summary, OfAWholeParticleSaysSoAndGivesItsCracksApart) {
  RunOutcome outcome = in_pieces(1);
  EXPECT_THAT(summary(finished(), outcome, "r", false), AllOf(HasSubstr("whole"), Not(HasSubstr("cracks"))));
  outcome.cracks.area = 2e-6;
  EXPECT_THAT(summary(finished(), outcome, "r", false),
              AllOf(HasSubstr("whole, in one piece\n"), HasSubstr("cracks            2 mm2"), Not(HasSubstr("pieces")),
                    Not(HasSubstr("largest"))));
}

TEST(Summary, OfPiecesCountsThem) {
  EXPECT_THAT(summary(finished(), in_pieces(3), "r", false),
              AllOf(HasSubstr("3 in all"), HasSubstr("largest piece"), Not(HasSubstr("whole"))));
}

TEST(Summary, OfAFailedRunHasNoBarsOfWhatIsNoNumber) {
  Simulation s = finished();
  s.ledger[EnergyTerm::Strain] = std::numeric_limits<double>::quiet_NaN();
  s.ledger[EnergyTerm::ToolImpact] = std::numeric_limits<double>::infinity();
  for (const bool utf8 : {false, true})
    EXPECT_THAT(summary(s, in_pieces(1), "r", utf8), AllOf(HasSubstr("nan %\n"), HasSubstr("inf %\n")));
}

}  // namespace
}  // namespace knap
