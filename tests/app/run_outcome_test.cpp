#include "app/run_outcome.hpp"

#include <gmock/gmock.h>

#include <limits>

namespace knap {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Simulation with_bad_balance() {
  Simulation s;
  s.reference.incident_energy = 2.0;
  s.ledger.reference = s.ledger.initial = 2.0;
  s.last_good_ledger[EnergyTerm::Kinetic] = 1.5;
  s.last_good_ledger[EnergyTerm::CrackFriction] = 0.5;
  s.ledger[EnergyTerm::Kinetic] = 1.4;
  s.ledger[EnergyTerm::CrackFriction] = 0.8;
  s.clock.step = 42;
  return s;
}

TEST(FailureMessage, NamesTheTermThatChangedMost) {
  EXPECT_THAT(failure_message(with_bad_balance(), StopReason::EnergyNotClosed),
              AllOf(HasSubstr("off by 10 %"), HasSubstr("step 42"), HasSubstr("crack_friction"),
                    HasSubstr("from 0.25 to 0.4")));
}

TEST(FailureMessage, NamesTheTermThatIsNoNumber) {
  Simulation s = with_bad_balance();
  s.ledger[EnergyTerm::Strain] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(failure_message(s, StopReason::NotFinite), AllOf(HasSubstr("not finite"), HasSubstr("strain")));
}

TEST(Status, OfEveryStopReason) {
  EXPECT_EQ(status(StopReason::AtRest), "finished");
  EXPECT_EQ(status(StopReason::EndTime), "finished");
  EXPECT_EQ(status(StopReason::Interrupted), "interrupted");
  EXPECT_EQ(status(StopReason::EnergyNotClosed), "failed");
  EXPECT_EQ(status(StopReason::NotFinite), "failed");
}

}  // namespace
}  // namespace knap
