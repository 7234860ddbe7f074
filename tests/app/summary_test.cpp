#include "app/summary.hpp"

#include <gmock/gmock.h>

#include <limits>

namespace knap {
namespace {

using testing::AllOf;
using testing::HasSubstr;

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

TEST(Summary, OfAFailedRunHasNoBarsOfWhatIsNoNumber) {
  Simulation s = finished();
  s.ledger[EnergyTerm::Strain] = std::numeric_limits<double>::quiet_NaN();
  s.ledger[EnergyTerm::ToolImpact] = std::numeric_limits<double>::infinity();
  for (const bool utf8 : {false, true})
    EXPECT_THAT(summary(s, in_pieces(1), "r", utf8), AllOf(HasSubstr("nan %\n"), HasSubstr("inf %\n")));
}

}  // namespace
}  // namespace knap
