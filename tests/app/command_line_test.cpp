// What a user meets on the command line: exit codes, messages, and what is left in folders.
#include <gmock/gmock.h>

#include "tests/app/program.hpp"

namespace knap {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class CommandLine : public ProgramTest {
 protected:
  CommandLine() { write("case.toml", breaking_case); }
  /// A run that takes no time.
  std::vector<std::string> short_run(std::vector<std::string> more) const {
    std::vector<std::string> arguments{"run", "case.toml", "--quiet", "--set", "run.end_time=0.2us"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
};

TEST_F(CommandLine, VersionAndHelp) {
  EXPECT_THAT(run({"--version"}).out, StartsWith("knap 0."));
  EXPECT_EQ(run({"--version"}).code, 0);
  EXPECT_THAT(run({"--help"}).out, AllOf(HasSubstr("run"), HasSubstr("check"), HasSubstr("mesh"), HasSubstr("keys")));
  EXPECT_EQ(run({"run", "--help"}).code, 0);
}

TEST_F(CommandLine, WrongArgumentsExitWith2) {
  EXPECT_EQ(run({}).code, 2);
  EXPECT_EQ(run({"walk"}).code, 2);
  EXPECT_EQ(run({"run"}).code, 2);
  EXPECT_EQ(run({"run", "case.toml", "--treads", "2"}).code, 2);
  EXPECT_EQ(run({"run", "case.toml", "--threads", "-1"}).code, 2);
  EXPECT_EQ(run({"run", "case.toml", "--resume", "--overwrite"}).code, 2);
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST_F(CommandLine, MisspeltCommandIsNamedWithTheNearestOne) {
  const Ended ended = run({"campain", "plan"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_EQ(ended.err, "error: knap has no command \"campain\" (did you mean \"campaign\"?); knap --help lists them\n");
  EXPECT_EQ(run({"analyze", "--help"}).code, 0);
}

TEST_F(CommandLine, MisspeltKeyIsNamedWithTheNearestOne) {
  write("bad.toml", std::string(breaking_case) + "[fractur]\nbeta = 1\n");
  EXPECT_THAT(run({"run", "bad.toml"}).err, AllOf(StartsWith("error: bad.toml:"), HasSubstr("\"fracture\"")));
  const Ended ended = run({"run", "case.toml", "--set", "impact.sped=3"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, AllOf(StartsWith("error: "), HasSubstr("\"speed\"")));
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST_F(CommandLine, MissingCaseFile) {
  for (const char* command : {"run", "check"}) {
    const Ended ended = run({command, "nowhere.toml"});
    EXPECT_EQ(ended.code, 2);
    EXPECT_THAT(ended.err, AllOf(StartsWith("error: "), HasSubstr("nowhere.toml")));
  }
}

TEST_F(CommandLine, ExistingFolderIsNeverTouched) {
  fs::create_directory(folder / "mine");
  write("mine/thesis.txt", "years of work");
  const Ended ended = run(short_run({"--out", "mine"}));
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, AllOf(HasSubstr("mine"), HasSubstr("--overwrite")));
  const Ended forced = run(short_run({"--out", "mine", "--overwrite"}));
  EXPECT_EQ(forced.code, 2);
  EXPECT_THAT(forced.err, HasSubstr("not written by Knap"));
  write("mine/effective.toml", "# mine\n");
  EXPECT_EQ(run(short_run({"--out", "mine", "--overwrite"})).code, 2);
  EXPECT_EQ(content(folder / "mine/thesis.txt"), "years of work");
  EXPECT_EQ(content(folder / "mine/effective.toml"), "# mine\n");
}

TEST_F(CommandLine, OverwriteRemovesOnlyWhatKnapWrote) {
  ASSERT_EQ(run(short_run({"--out", "r"})).code, 0);
  write("r/notes.txt", "mine");
  write("r/frames/notes.txt", "mine");
  write("r/frames/frame_0099.vtu", "old");
  EXPECT_EQ(run(short_run({"--out", "r"})).code, 2);
  ASSERT_EQ(run(short_run({"--out", "r", "--overwrite"})).code, 0);
  EXPECT_EQ(content(folder / "r/notes.txt"), "mine");
  EXPECT_EQ(content(folder / "r/frames/notes.txt"), "mine");
  EXPECT_FALSE(fs::exists(folder / "r/frames/frame_0099.vtu"));
}

TEST_F(CommandLine, EmptyFolderAndDefaultFolder) {
  fs::create_directory(folder / "empty");
  EXPECT_EQ(run(short_run({"--out", "empty"})).code, 0);
  EXPECT_EQ(run(short_run({})).code, 0);
  EXPECT_TRUE(fs::exists(folder / "out/case/report.json"));
}

TEST_F(CommandLine, FolderThatCannotBe) {
  EXPECT_EQ(run(short_run({"--out", "case.toml"})).code, 2);
  EXPECT_EQ(run(short_run({"--out", "case.toml/below"})).code, 2);
  EXPECT_EQ(run(short_run({"--out", "/proc/knap"})).code, 2);
}

TEST_F(CommandLine, SanityCardRefusesAndLeavesNoFolder) {
  const std::vector<std::string> strict{"--set", "fracture.allow_unresolved=false"};
  const Ended ended = run(short_run(strict));
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, AllOf(HasSubstr("cohesive zone"), HasSubstr("mesh.element_size = "),
                               HasSubstr("fracture.allow_unresolved")));
  EXPECT_FALSE(fs::exists(folder / "out/case"));
  EXPECT_EQ(run({"check", "case.toml", "--set", "fracture.allow_unresolved=false"}).code, 2);
}

TEST_F(CommandLine, CheckPrintsTheCardWithoutMeshing) {
  const Ended ended = run({"check", "case.toml"});
  EXPECT_EQ(ended.code, 0);
  EXPECT_THAT(ended.out, AllOf(HasSubstr("Sanity card"), HasSubstr("cohesive zone"), HasSubstr("estimated"),
                               HasSubstr("the case is valid")));
  EXPECT_THAT(ended.err, StartsWith("warning: "));
  EXPECT_EQ(run({"check", "case.toml", "--set", "impact.speed=-3"}).code, 2);
}

TEST_F(CommandLine, MeshIsWrittenWithItsQuality) {
  const Ended ended = run({"mesh", "case.toml", "--out", "mesh.vtu"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, AllOf(HasSubstr("tets"), HasSubstr("shape quality"), HasSubstr("mesh.vtu")));
  EXPECT_GT(fs::file_size(folder / "mesh.vtu"), 10000u);
  EXPECT_EQ(run({"mesh", "case.toml", "--out", "mesh.stl"}).code, 2);
  EXPECT_EQ(run({"mesh", "case.toml", "--out", "nowhere/mesh.vtu"}).code, 1);
}

TEST_F(CommandLine, KeysAreListed) {
  EXPECT_THAT(run({"keys"}).out, AllOf(HasSubstr("impact.speed"), HasSubstr("m/s")));
  EXPECT_THAT(run({"keys", "--markdown"}).out, StartsWith("# Case reference"));
}

TEST_F(CommandLine, QuietPrintsOnlyWarnings) {
  const Ended quiet = run(short_run({}));
  EXPECT_EQ(quiet.out, "");
  EXPECT_THAT(quiet.err, StartsWith("warning: "));
  EXPECT_EQ(quiet.err.find("Sanity"), std::string::npos);
}

}  // namespace
}  // namespace knap
