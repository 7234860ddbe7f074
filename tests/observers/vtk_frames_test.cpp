#include "observers/vtk_frames.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <set>
#include <sstream>

#include "observers/crack_grid.hpp"
#include "tests/observers/breaking_box.hpp"

namespace knap {
namespace {

namespace fs = std::filesystem;
using VtkFramesTest = ObserverTest;

std::vector<Index> as_they_are(std::span<const Index> label, std::span<const double>) {
  return {label.begin(), label.end()};
}

std::set<std::string> files(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename().string());
  return names;
}

std::string text(const fs::path& path) {
  std::ostringstream out;
  out << std::ifstream(path).rdbuf();
  return out.str();
}

TEST_F(VtkFramesTest, LastFrameIsWrittenOnce) {
  Simulation s = breaking_box();
  VtkFrames frames(folder, 10, as_they_are);
  frames.look(s);
  advance(s, 10);
  frames.look(s);
  frames.look(s);  // the end of the run
  EXPECT_EQ(files(folder / "frames"), (std::set<std::string>{"frame_0000.vtu", "frame_0001.vtu"}));
  EXPECT_EQ(files(folder / "cracks"), (std::set<std::string>{"cracks_0000.vtu", "cracks_0001.vtu"}));
  EXPECT_THAT(text(folder / "frames.pvd"), testing::HasSubstr("frames/frame_0001.vtu"));
}

TEST_F(VtkFramesTest, ResumeDropsWhatIsBehindTheCheckpoint) {
  Simulation s = breaking_box();
  {
    VtkFrames frames(folder, 10, as_they_are);
    for (int i = 0; i < 3; ++i) {
      frames.look(s);
      advance(s, 10);
    }
    advance(s, 5);
    frames.look(s);  // interrupted at step 35
  }
  VtkFrames again(folder, 10, as_they_are);
  again.resume(15, s.clock.dt);
  EXPECT_EQ(files(folder / "frames"), (std::set<std::string>{"frame_0000.vtu", "frame_0001.vtu"}));
  again.look(s);
  EXPECT_EQ(files(folder / "frames"), (std::set<std::string>{"frame_0000.vtu", "frame_0001.vtu", "frame_0002.vtu"}));
}

TEST_F(VtkFramesTest, GridsHaveTheFieldsAndDoNotTouchTheRun) {
  Simulation s = breaking_box();
  advance(s, 300);
  const auto stress_before = s.elastic.stress.front().xx;
  const VtkGrid grid = particle_grid(s, as_they_are);
  EXPECT_EQ(s.elastic.stress.front().xx, stress_before);
  EXPECT_EQ(grid.points.size(), at(s.nodes.size()));
  std::set<std::string> names;
  for (const auto& field : grid.cell_fields) names.insert(field.name);
  for (const auto& field : grid.cell_int_fields) names.insert(field.name);
  for (const auto& field : grid.point_fields) names.insert(field.name);
  EXPECT_EQ(names, (std::set<std::string>{"fragment", "fragment_strict", "particle", "damage [-]", "stress [Pa]",
                                          "von_mises [Pa]", "largest_principal_stress [Pa]", "velocity [m/s]",
                                          "displacement [m]"}));
}

TEST_F(VtkFramesTest, CracksAreTheFacetsThatAreNotBonded) {
  Simulation s = breaking_box();
  EXPECT_TRUE(crack_grid(s).triangles.empty());
  advance(s, 300);
  const VtkGrid grid = crack_grid(s);
  EXPECT_EQ(grid.triangles.size(), static_cast<std::size_t>(s.totals.inserted_facets));
  for (const auto& field : grid.cell_fields) {
    if (field.name != "mode_mixity [-]") continue;
    EXPECT_THAT(field.values, testing::Each(testing::AllOf(testing::Ge(0.0), testing::Le(1.0))));
  }
  // Back in the whole particle the corners are its vertices.
  const VtkField& displacement = grid.point_fields.front();
  const Vec3 moved(displacement.values[0], displacement.values[1], displacement.values[2]);
  const Vec3 origin = grid.points[0] - moved;
  double nearest = 1.0;
  for (const Vec3& x : s.reference.vertices) nearest = std::min(nearest, (x - origin).norm());
  EXPECT_LT(nearest, 1e-15);
}

}  // namespace
}  // namespace knap
