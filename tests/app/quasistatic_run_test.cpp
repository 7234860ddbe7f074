// A small particle pressed from the onset of its fracture on, through the program.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "io/csv_table.hpp"
#include "tests/app/program.hpp"
#include "tests/support/pressed_case.hpp"

namespace knap {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class QuasistaticRun : public ProgramTest {
 protected:
  QuasistaticRun() { write("case.toml", coarse_pressed_case(from_the_onset)); }
};

TEST_F(QuasistaticRun, TellsTheOnsetAndGoesOnFromIt) {
  const Ended ended = run({"run", "case.toml", "--out", "r"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("first crack"));
  EXPECT_THAT(ended.out, testing::Not(HasSubstr("rebound")));
  const auto found = report("r");
  EXPECT_EQ(found["stop_reason"], "force dropped");
  EXPECT_GT(found["cracks"]["inserted_facets"], 0);
  EXPECT_TRUE(found["rebound"]["restitution_normal"].is_null());
  const auto& onset = found["quasistatic"];
  const double approach = onset["approach"], force = onset["onset_force"];
  EXPECT_GT(onset["newton_iterations"], 0);
  EXPECT_GT(onset["wall_s"], 0.0);

  // The way of the platen counts from where the case puts it: a free way, the approach, the motion.
  const double time = found["time"]["end"];
  const double free_way = 1e-3 * found["sanity"]["contact_element_size"].get<double>();
  const double way = -found["tools"][1]["displacement"][2].get<double>();
  EXPECT_NEAR(way - 8.0 * time - approach, free_way, 2.0 * free_way);  // a gap below too; it may stand on an edge
  const CsvColumns history = read_csv(folder / "r/history.csv");
  EXPECT_NEAR(history.column("upper_displacement_z [m]").front(), 8.0 * time - way, 1e-12);

  // The curve begins where both touch, without force, and has the onset's force there where the run starts.
  const CsvColumns curve = read_csv(folder / "r/force_displacement.csv");
  const auto& times = curve.column("time [s]");
  const auto& ways = curve.column("displacement [m]");
  const auto& impulse = curve.column("impulse [N s]");
  const auto start = static_cast<std::size_t>(std::find(times.begin(), times.end(), 0.0) - times.begin());
  ASSERT_EQ(start, onset["load_steps"].get<std::size_t>());
  EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
  EXPECT_TRUE(std::is_sorted(ways.begin(), ways.end()));
  EXPECT_NEAR(times.front(), -approach / 8.0, 1e-12);
  EXPECT_NEAR(ways[start] - ways.front(), approach, 1e-12);
  EXPECT_EQ(impulse[start], 0.0);
  const auto& forces = curve.column("force [N]");
  EXPECT_EQ(forces.front(), 0.0);
  EXPECT_EQ(forces[start], force);
  EXPECT_TRUE(std::is_sorted(forces.begin(), forces.begin() + static_cast<std::ptrdiff_t>(start) + 1));
  const double mean_force = (impulse[start] - impulse[start - 1]) / (times[start] - times[start - 1]);
  EXPECT_NEAR(mean_force, 0.5 * (forces[start - 1] + force), 1e-9 * force);
  EXPECT_GE(found["compression"]["fracture_force"], force);
}

TEST_F(QuasistaticRun, ResumesToTheSameBits) {
  // Small steps, so that the run lasts long enough to be stopped on a busy machine.
  write("case.toml", coarse_pressed_case(from_the_onset) + "[run]\nstep_safety = 0.1\n");
  const std::vector<std::string> whole{"run", "case.toml", "--out", "whole", "--quiet", "--threads", "1"};
  ASSERT_EQ(run(whole).code, 0);
  const Started first =
      start({"run", "case.toml", "--out", "parts", "--quiet", "--set", "output.checkpoint_interval=0.01"});
  ASSERT_TRUE(wait_for(folder / "parts/checkpoint.h5", first));
  ::kill(first.pid, SIGINT);
  ASSERT_EQ(wait(first).code, 130);
  const Ended rest =
      run({"run", "case.toml", "--out", "parts", "--quiet", "--resume", "--set", "output.checkpoint_interval=0.01"});
  ASSERT_EQ(rest.code, 0) << rest.err;
  const auto one = report("whole"), two = report("parts");
  EXPECT_FALSE(two["performance"]["resumed_from_step"].is_null());
  EXPECT_EQ(one["state_hash"], two["state_hash"]);
  EXPECT_EQ(one["compression"], two["compression"]);
  EXPECT_EQ(content(folder / "whole/force_displacement.csv"), content(folder / "parts/force_displacement.csv"));
}

TEST_F(QuasistaticRun, RefusesACaseThatIsAnother) {
  const Ended ended = run({"run", "case.toml", "--out", "r", "--set", "run.gravity=[0,0,-9.81]"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("run.gravity: must be [0, 0, 0] when quasistatic.enabled = true"));
  EXPECT_FALSE(fs::exists(folder / "r"));
}

}  // namespace
}  // namespace knap
