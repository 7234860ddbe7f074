#include "report/packed_surfaces.hpp"

#include <gmock/gmock.h>
#include <zlib.h>

#include <bit>
#include <cmath>
#include <vector>

#include "io/vtk_writer.hpp"
#include "tests/report/sample_campaign.hpp"
#include "tests/support/temporary_folder.hpp"

namespace knap {
namespace {

// Reads the bytes back as the page does.
class Reader {
 public:
  explicit Reader(const std::string& packed) : bytes_(1 << 22, '\0') {
    uLongf size = static_cast<uLongf>(bytes_.size());
    EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(bytes_.data()), &size, reinterpret_cast<const Bytef*>(packed.data()),
                         static_cast<uLong>(packed.size())),
              Z_OK);
    bytes_.resize(size);
  }
  std::vector<std::uint32_t> take(Index count, unsigned width) {
    std::vector<std::uint32_t> values(at(count), 0);
    for (unsigned plane = 0; plane < width; ++plane)
      for (std::uint32_t& value : values)
        value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes_.at(place_++))) << 8 * plane;
    return values;
  }
  bool is_at_end() const { return place_ == bytes_.size(); }

 private:
  std::string bytes_;
  std::size_t place_ = 0;
};

class PackedSurfacesTest : public TemporaryFolder {};

TEST_F(PackedSurfacesTest, ReadBackTheSameUpToTheGrid) {
  write_vtu(folder / "frame.vtu", broken_ball_frame(10, 4));
  const FragmentSurfaces surfaces = read_fragment_surfaces(folder / "frame.vtu");
  const PackedSurfaces result = packed(surfaces);
  ASSERT_GT(result.num_fragments, 4);
  Reader reader(result.bytes);
  const auto points_of = reader.take(result.num_fragments, 4), triangles_of = reader.take(result.num_fragments, 4);
  const auto share = reader.take(result.num_fragments, 4), centre = reader.take(3 * result.num_fragments, 4);
  double sum = 0.0;
  for (Index f = 0; f < result.num_fragments; ++f) {
    EXPECT_EQ(points_of[at(f)],
              static_cast<std::uint32_t>(surfaces.first_point[at(f) + 1] - surfaces.first_point[at(f)]));
    EXPECT_EQ(triangles_of[at(f)],
              static_cast<std::uint32_t>(surfaces.first_triangle[at(f) + 1] - surfaces.first_triangle[at(f)]));
    sum += std::bit_cast<float>(share[at(f)]);
    for (const int axis : {0, 1, 2})
      EXPECT_NEAR(std::bit_cast<float>(centre[at(axis * result.num_fragments + f)]), surfaces.centre[at(f)][axis],
                  1e-9);
  }
  EXPECT_NEAR(sum, 1.0, 1e-5);
  for (const std::size_t axis : {0u, 1u, 2u}) {
    const auto steps = reader.take(result.num_points, 2);
    std::uint32_t now = 0;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      now = (now + steps[i]) & 0xffff;
      ASSERT_NEAR(result.origin[axis] + result.step * now, surfaces.points[i][axis], 0.51 * result.step);
    }
  }
  const auto corners = reader.take(3 * result.num_triangles, 4);
  std::uint32_t next = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::uint32_t corner = next - corners[i];
    ASSERT_EQ(corner, static_cast<std::uint32_t>(surfaces.triangles[i / 3][i % 3]));
    next += corner == next;
  }
  const auto is_fracture = reader.take(result.num_triangles, 1);
  EXPECT_TRUE(std::equal(is_fracture.begin(), is_fracture.end(), surfaces.is_fracture.begin()));
  EXPECT_TRUE(reader.is_at_end());
}

TEST_F(PackedSurfacesTest, GridIsFineAndBytesAreFew) {
  write_vtu(folder / "frame.vtu", broken_ball_frame(20, 3));
  const FragmentSurfaces surfaces = read_fragment_surfaces(folder / "frame.vtu");
  const PackedSurfaces result = packed(surfaces);
  EXPECT_LT(result.step, 3e-8) << "of a ball of 1.5 mm";
  EXPECT_LT(result.bytes.size(), 10 * surfaces.triangles.size());
}

}  // namespace
}  // namespace knap
