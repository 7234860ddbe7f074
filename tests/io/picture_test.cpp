#include "io/picture.hpp"

#include <gmock/gmock.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <cstdlib>
#include <optional>
#include <set>
#include <stdexcept>

#include "core/errors.hpp"
#include "core/parallel.hpp"
#include "io/vtk_writer.hpp"
#include "tests/io/broken_ball.hpp"
#include "tests/support/temporary_folder.hpp"

namespace knap {
namespace {

using testing::HasSubstr;

/// Another value of an environment variable (or none), while it lives.
class Environment {
 public:
  Environment(const char* name, const char* value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    set(value);
  }
  ~Environment() { set(old_ ? old_->c_str() : nullptr); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  void set(const char* value) { value != nullptr ? setenv(name_, value, 1) : unsetenv(name_); }

  const char* name_;
  std::optional<std::string> old_;
};

class Picture : public TemporaryFolder {
 protected:
  /// The number of colours in each third of a picture of the right size.
  std::array<std::size_t, 3> colours_of_views() const {
    vtkNew<vtkPNGReader> reader;
    reader->SetFileName(png.c_str());
    reader->Update();
    vtkImageData* image = reader->GetOutput();
    EXPECT_EQ(image->GetDimensions()[0], 2400);
    EXPECT_EQ(image->GetDimensions()[1], 900);
    std::array<std::set<std::array<unsigned char, 3>>, 3> colours;
    for (int y = 150; y < 750; y += 3) {
      for (int x = 0; x < 2400; x += 3) {
        const auto* rgb = static_cast<const unsigned char*>(image->GetScalarPointer(x, y, 0));
        colours[static_cast<std::size_t>(x / 800)].insert({rgb[0], rgb[1], rgb[2]});
      }
    }
    return {colours[0].size(), colours[1].size(), colours[2].size()};
  }
  void expect_three_views() const {
    const auto counts = colours_of_views();
    for (const std::size_t count : counts) EXPECT_GT(count, 50u);
    EXPECT_EQ(num_files(), 1u);
  }

  std::filesystem::path png = folder / "picture.png";
};

TEST_F(Picture, NeedsNoDisplay) {
  const Environment no_display("DISPLAY", nullptr);
  render_picture(png, broken_ball(8));
  expect_three_views();
}

TEST_F(Picture, UnusableDisplayIsReplacedByAnOwnOne) {
  const Environment bad_display("DISPLAY", ":4711");
  render_picture(png, broken_ball(6));
  expect_three_views();
}

TEST_F(Picture, DrawsAfterThreadsHaveRunInThisProcess) {
  std::vector<int> seen(100000, 0);
  parallel_for(to_index(seen.size()), [&](Index i) { seen[at(i)] = i; });
  const PictureInput input = broken_ball(12);
  VtkGrid grid;
  grid.points = input.points;
  grid.tets = input.tets;
  write_vtu(folder / "frame.vtu", grid);
  std::filesystem::remove(folder / "frame.vtu");
  const Environment no_display("DISPLAY", nullptr);
  render_picture(png, input);
  expect_three_views();
}

TEST_F(Picture, OneTetWithoutWallAndTextsIsEnough) {
  PictureInput input;
  input.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  input.tets = {{0, 1, 2, 3}};
  input.fragment_of_tet = {0};
  input.fragment_mass = {1.0};
  input.damage_of_tet = {0.5};
  input.title = std::string(500, 'W');
  render_picture(png, input);
  for (const std::size_t count : colours_of_views()) EXPECT_GT(count, 1u);
}

TEST_F(Picture, WithoutXvfbTheMessageNamesThePackages) {
  const Environment no_display("DISPLAY", nullptr);
  const Environment no_programs("PATH", folder.c_str());
  const std::string message = message_of<RuntimeFailure>([&] { render_picture(png, broken_ball(4)); });
  EXPECT_THAT(message, HasSubstr("picture: no virtual display"));
  EXPECT_THAT(message, HasSubstr("apt-get install xvfb libgl1-mesa-dri"));
  EXPECT_EQ(num_files(), 0u);
}

TEST_F(Picture, TimeoutIsAFailureNotAHang) {
  const Environment no_display("DISPLAY", nullptr);
  PictureInput input = broken_ball(4);
  input.timeout = std::chrono::seconds(0);
  EXPECT_THAT(message_of<RuntimeFailure>([&] { render_picture(png, input); }), HasSubstr("no result after 0 s"));
}

TEST_F(Picture, UnwritablePlaceIsNamed) {
  const std::filesystem::path place = below_a_file("picture.png");
  EXPECT_THAT(message_of<RuntimeFailure>([&] { render_picture(place, broken_ball(4)); }), HasSubstr(place.string()));
}

TEST_F(Picture, ArraysThatDoNotFitAreRefused) {
  EXPECT_THROW(render_picture(png, {}), RuntimeFailure);
  PictureInput input = broken_ball(4);
  input.damage_of_tet.pop_back();
  EXPECT_THROW(render_picture(png, input), std::invalid_argument);
  input = broken_ball(4);
  input.fragment_of_tet[0] = to_index(input.fragment_mass.size());
  EXPECT_THROW(render_picture(png, input), std::invalid_argument);
  input = broken_ball(4);
  input.broken_facets.push_back({0, 1, -1});
  EXPECT_THROW(render_picture(png, input), std::invalid_argument);
  input = broken_ball(4);
  input.points[0].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(render_picture(png, input), RuntimeFailure);
}

}  // namespace
}  // namespace knap
