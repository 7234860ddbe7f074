#include "report/packed_surfaces.hpp"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "core/errors.hpp"

namespace knap {
namespace {

template <class T>
void add_planes(std::string& bytes, const std::vector<T>& values) {
  for (std::size_t k = 0; k < sizeof(T); ++k)
    for (const T value : values) bytes += static_cast<char>(value >> 8 * k & 0xff);
}

std::vector<std::uint32_t> bits(const std::vector<float>& values) {
  std::vector<std::uint32_t> result;
  for (const float value : values) result.push_back(std::bit_cast<std::uint32_t>(value));
  return result;
}

std::vector<std::uint32_t> differences(const std::vector<Index>& first) {
  std::vector<std::uint32_t> result;
  for (std::size_t i = 1; i < first.size(); ++i) result.push_back(static_cast<std::uint32_t>(first[i] - first[i - 1]));
  return result;
}

void add_fragments(std::string& bytes, const FragmentSurfaces& surfaces) {
  add_planes(bytes, differences(surfaces.first_point));
  add_planes(bytes, differences(surfaces.first_triangle));
  const double total = std::accumulate(surfaces.volume.begin(), surfaces.volume.end(), 0.0);
  std::vector<float> shares, centres;
  for (const double volume : surfaces.volume) shares.push_back(static_cast<float>(total > 0.0 ? volume / total : 0.0));
  for (const int axis : {0, 1, 2})
    for (const Vec3& centre : surfaces.centre) centres.push_back(static_cast<float>(centre[axis]));
  add_planes(bytes, bits(shares));
  add_planes(bytes, bits(centres));
}

void set_grid(PackedSurfaces& target, const FragmentSurfaces& surfaces) {
  Eigen::AlignedBox3d box;
  for (const auto& x : surfaces.points) box.extend(Vec3(x[0], x[1], x[2]));
  if (box.isEmpty()) return;
  target.origin = {box.min().x(), box.min().y(), box.min().z()};
  target.step = box.sizes().maxCoeff() / 65535.0;
}

void add_points(std::string& bytes, const FragmentSurfaces& surfaces, const PackedSurfaces& grid) {
  for (const std::size_t axis : {0u, 1u, 2u}) {
    std::vector<std::uint16_t> steps;
    std::uint16_t last = 0;
    for (const auto& x : surfaces.points) {
      const double place = grid.step > 0.0 ? (x[axis] - grid.origin[axis]) / grid.step : 0.0;
      const auto now = static_cast<std::uint16_t>(std::clamp(std::lround(place), 0l, 65535l));
      steps.push_back(static_cast<std::uint16_t>(now - last));
      last = now;
    }
    add_planes(bytes, steps);
  }
}

void add_triangles(std::string& bytes, const FragmentSurfaces& surfaces) {
  std::vector<std::uint32_t> corners;
  Index next = 0;  // points are numbered as they come first in the triangles
  for (const auto& triangle : surfaces.triangles)
    for (const Index point : triangle) {
      corners.push_back(static_cast<std::uint32_t>(next - point));
      next = std::max(next, point + 1);
    }
  add_planes(bytes, corners);
  bytes.append(surfaces.is_fracture.begin(), surfaces.is_fracture.end());
}

std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string result(size, '\0');
  const int outcome = compress2(reinterpret_cast<Bytef*>(result.data()), &size,
                                reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()), 9);
  if (outcome != Z_OK) throw RuntimeFailure("zlib: no memory to compress the surfaces of fragments");
  result.resize(size);
  return result;
}

}  // namespace

PackedSurfaces packed(const FragmentSurfaces& surfaces) {
  PackedSurfaces result;
  result.num_fragments = surfaces.num_fragments();
  result.num_points = to_index(surfaces.points.size());
  result.num_triangles = to_index(surfaces.triangles.size());
  set_grid(result, surfaces);
  std::string bytes;
  add_fragments(bytes, surfaces);
  add_points(bytes, surfaces, result);
  add_triangles(bytes, surfaces);
  result.bytes = deflated(bytes);
  return result;
}

}  // namespace knap
