// A run whose energies do not close stops with exit code 3, and what it leaves can be read. The particle spins so fast
// that it is stretched several times over: stiffer by far than what the time step was chosen for.
#include <gmock/gmock.h>

#include "io/csv_table.hpp"
#include "tests/app/program.hpp"

namespace knap {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

class EnergyStop : public ProgramTest {
 protected:
  EnergyStop() { write("case.toml", elastic_case); }

  Ended spinning(const std::string& rate) const {
    return run({"run", "case.toml", "--out", "r", "--set", "impact.spin=[" + rate + ", 0, 0]", "--set",
                "run.end_time=20us", "--set", "output.frames=2"});
  }
  void expect_failed_and_readable(const std::string& stop_reason) const {
    const json report = this->report("r");
    EXPECT_EQ(report["status"], "failed");
    EXPECT_EQ(report["stop_reason"], stop_reason);
    EXPECT_LT(report["time"]["end"], 19e-6);
    EXPECT_EQ(read_csv(folder / "r/history.csv").column("time [s]").back(), report["time"]["end"]);
    EXPECT_EQ(read_csv(folder / "r/fragments.csv").column("id").size(), 1u);
    EXPECT_THAT(content(folder / "r/frames.pvd"), HasSubstr("</VTKFile>"));
  }
};

TEST_F(EnergyStop, EndsARunThatDoesNotClose) {
  const Ended ended = spinning("4e6");
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(ended.err, AllOf(HasSubstr("the energy balance is off by"), HasSubstr("changed most")));
  EXPECT_THAT(ended.out, HasSubstr("energy not closed"));
  expect_failed_and_readable("energy not closed");
  EXPECT_GT(report("r")["energy"]["closure_error"], 0.05);
}

TEST_F(EnergyStop, EndsARunThatIsNotFinite) {
  const Ended ended = spinning("1e7");
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(ended.err, HasSubstr("not finite"));
  EXPECT_THAT(ended.out, HasSubstr("not finite"));
  expect_failed_and_readable("not finite");
}

}  // namespace
}  // namespace knap
