// A new run into the folder of an old one: what it leaves of that.
#include <gmock/gmock.h>

#include <map>

#include "tests/app/program.hpp"

namespace knap {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Overwrite : public ProgramTest {
 protected:
  Overwrite() {
    write("case.toml", breaking_case);
    const Ended ended = run({"run", "case.toml", "--quiet", "--out", "r", "--set", "run.end_time=0.2us"});
    EXPECT_EQ(ended.code, 0) << ended.err;
    old = files();
    EXPECT_GT(old.size(), 10u);
  }

  /// Every file of the run, and when it was last written.
  using Files = std::map<std::string, std::pair<std::string, fs::file_time_type>>;
  Files files() const {
    Files all;
    for (const auto& entry : fs::recursive_directory_iterator(folder / "r"))
      if (entry.is_regular_file()) all[entry.path().string()] = {content(entry.path()), entry.last_write_time()};
    return all;
  }
  std::vector<std::string> overwriting(std::vector<std::string> more) const {
    std::vector<std::string> arguments{"run", "case.toml", "--out", "r", "--overwrite"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  /// With a mesh that takes seconds, so that the signal comes before the first step.
  Ended interrupted_while_meshing(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(),
                     {"--set", "mesh.element_size=0.08mm", "--set", "mesh.contact_element_size=0.08mm"});
    const Started started = start(arguments);
    for (int i = 0; i < 1000 && content(started.err).find("Meshing") == std::string::npos; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    ::kill(started.pid, SIGINT);
    return wait(started);
  }

  Files old;
};

TEST_F(Overwrite, ACaseThatTheSanityCardRefusesLeavesTheOldResults) {
  EXPECT_EQ(run(overwriting({"--set", "fracture.allow_unresolved=false"})).code, 2);
  EXPECT_EQ(files(), old);
}

TEST_F(Overwrite, AMeshThatFailsLeavesTheOldResults) {
  write("broken.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n");
  std::string text = breaking_case;
  text.replace(text.find("diameter"), std::string("diameter = \"2 mm\"").size(),
               "shape = \"mesh_file\"\nmesh_file = \"broken.msh\"");
  text.erase(text.find("[mesh]"), text.find("[material]") - text.find("[mesh]"));
  write("case.toml", text);
  const Ended ended = run(overwriting({}));
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("broken.msh"));
  EXPECT_EQ(files(), old);
}

TEST_F(Overwrite, AnInterruptWhileMeshingLeavesTheOldResults) {
  const Ended ended = interrupted_while_meshing(overwriting({}));
  EXPECT_EQ(ended.code, 130);
  EXPECT_THAT(ended.err, HasSubstr("before the first step"));
  EXPECT_EQ(files(), old);
}

TEST_F(Overwrite, AnInterruptWhileMeshingLeavesNoNewFolder) {
  EXPECT_EQ(interrupted_while_meshing({"run", "case.toml", "--out", "new"}).code, 130);
  EXPECT_FALSE(fs::exists(folder / "new"));
}

TEST_F(Overwrite, ARunThatStartsReplacesTheOldResultsTheLogTooWithItsFirstLine) {
  ASSERT_EQ(run(overwriting({"--set", "run.end_time=0.1us"})).code, 0);
  const std::string log = content(folder / "r/log.txt");
  EXPECT_THAT(log.substr(0, log.find('\n')), HasSubstr("Knap "));
  EXPECT_THAT(log, HasSubstr("Sanity card"));
  EXPECT_EQ(log.find("stopped at"), log.rfind("stopped at"));  // one run's
  EXPECT_LT(report("r")["time"]["end"], 0.15e-6);
}

TEST_F(Overwrite, AFolderInWhichAnotherRunWritesIsLeftToIt) {
  const Started first = start({"run", "case.toml", "--quiet", "--out", "busy", "--set", "run.end_time=20us"});
  ASSERT_TRUE(wait_for(folder / "busy/history.csv", first));
  const Ended second = run({"run", "case.toml", "--out", "busy", "--overwrite"});
  EXPECT_EQ(second.code, 2);
  EXPECT_THAT(second.err, HasSubstr("another run writes here"));
  EXPECT_EQ(wait(first).code, 0);
  EXPECT_NEAR(report("busy")["time"]["end"].get<double>(), 20e-6, 0.1e-6);
}

}  // namespace
}  // namespace knap
