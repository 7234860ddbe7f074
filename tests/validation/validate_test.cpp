// The harness of the validation: what it runs, what it writes, and that nothing out of tolerance goes unnoticed.
#include "validation/validate.hpp"

#include <gmock/gmock.h>

#include <csignal>
#include <limits>

#include "core/errors.hpp"
#include "tests/support/temporary_folder.hpp"
#include "validation/record.hpp"

namespace knap {
namespace {

using testing::HasSubstr;

void show_good(Evidence& evidence) {
  evidence.relative("force [N]", 1.04, 1.0, 0.05, "a reason");
  evidence.tell("steps", 7.0, "told");
  evidence.curve({{"x [m]", {1.0, 2.0}}, {"y [N]", {3.0, 4.0}}});
}
void show_bad(Evidence& evidence) { evidence.at_most("error [-]", 2e-10, 1e-10, "round-off"); }
void show_nan(Evidence& evidence) {
  evidence.absolute("angle [deg]", std::numeric_limits<double>::quiet_NaN(), 1.0, 0.5, "a reason");
}
void show_nothing(Evidence&) {}
void show_broken(Evidence&) { throw RuntimeFailure("the energy does not close | ever"); }
void show_crash(Evidence&) { std::raise(SIGKILL); }

class Validation : public TemporaryFolder {
 protected:
  int run(std::vector<Problem> problems, ValidateOptions options = {}) {
    problems_ = std::move(problems);
    options.sources = folder;
    options.out = folder / "out";
    return validate(problems_, options);
  }
  std::string table() const { return content(folder / "out/results.md"); }
  Record record(const std::string& name) const { return *read_record(folder / "out" / name / "result.json"); }

 private:
  std::vector<Problem> problems_;
};

TEST_F(Validation, WhatLiesInToleranceEndsWithZero) {
  EXPECT_EQ(run({{"good", "elastic", "exact | so to say", show_good}}), 0);
  EXPECT_THAT(table(), HasSubstr("| good | exact \\| so to say | force [N] | 1 | 5 %: a reason | 1.04 | passes |"));
  EXPECT_THAT(table(), HasSubstr("| steps | - | told | 7 | told |"));
  EXPECT_THAT(table(), HasSubstr("1 of 1 problems run: 1 metrics in tolerance, 0 OUT"));
  EXPECT_EQ(content(folder / "out/good/curve.csv"), "x [m],y [N]\n1,3\n2,4\n");
}

TEST_F(Validation, WhatIsOutEndsWithOne) {
  const Problem good{"good", "elastic", "", show_good};
  EXPECT_EQ(run({good, {"bad", "elastic", "", show_bad}}), 1);
  EXPECT_THAT(table(), HasSubstr("| at most 1e-10: round-off | 2e-10 | **OUT** |"));
  EXPECT_EQ(run({{"nan", "elastic", "", show_nan}}), 1);
  EXPECT_THAT(table(), HasSubstr("**OUT**"));
  EXPECT_EQ(run({{"nothing", "elastic", "", show_nothing}}), 1);
  EXPECT_THAT(table(), HasSubstr("**failed**: it compared nothing"));
}

TEST_F(Validation, AProblemThatBreaksStopsNoOther) {
  EXPECT_EQ(run({{"broken", "elastic", "", show_broken},
                 {"crash", "elastic", "", show_crash},
                 {"good", "elastic", "", show_good}},
                {.jobs = 2}),
            1);
  EXPECT_EQ(record("broken").failure, "the energy does not close | ever");
  EXPECT_THAT(record("crash").failure, HasSubstr("signal 9"));
  EXPECT_TRUE(passes(record("good")));
  EXPECT_THAT(table(), HasSubstr("2 problems failed"));
}

TEST_F(Validation, WhatWasRunBeforeStaysInTheTable) {
  const std::vector<Problem> problems{{"good", "elastic", "", show_good}, {"bad", "elastic", "", show_bad, false}};
  EXPECT_EQ(run(problems), 1);
  EXPECT_EQ(run(problems, {.only = {"good"}}), 0);
  EXPECT_THAT(table(), HasSubstr("| bad |"));
  EXPECT_THAT(table(), HasSubstr("**OUT**"));
}

TEST_F(Validation, ShortLeavesOutWhatTakesLong) {
  EXPECT_EQ(run({{"good", "elastic", "", show_good}, {"bad", "elastic", "", show_bad, false}}, {.is_short = true}), 0);
  EXPECT_FALSE(std::filesystem::exists(folder / "out/bad"));
}

TEST_F(Validation, AnUnknownNameGetsASuggestion) {
  const std::string message = message_of<InputError>([&] {
    run({{"hertz", "elastic", "", show_good}}, {.only = {"herz"}});
  });
  EXPECT_THAT(message, HasSubstr("herz"));
  EXPECT_THAT(message, HasSubstr("did you mean hertz?"));
}

TEST_F(Validation, ARecordComesBackAsItWas) {
  Record record{.commit = "abc", .date = "2026-01-02 03:04", .seconds = 1.5};
  record.metrics.push_back({.name = "x [m]", .value = std::numeric_limits<double>::quiet_NaN(), .low = 0.1});
  write_record(folder / "result.json", record);
  const Record back = *read_record(folder / "result.json");
  EXPECT_EQ(back.commit, "abc");
  EXPECT_EQ(back.seconds, 1.5);
  ASSERT_EQ(back.metrics.size(), 1u);
  EXPECT_TRUE(std::isnan(back.metrics[0].value));
  EXPECT_EQ(back.metrics[0].low, 0.1);
  EXPECT_TRUE(std::isinf(back.metrics[0].high));
  EXPECT_EQ(judge(back.metrics[0]), Judgement::Out);
  std::ofstream(folder / "result.json") << "{";
  EXPECT_THROW(read_record(folder / "result.json"), InputError);
}

}  // namespace
}  // namespace knap
