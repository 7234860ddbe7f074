#include "meshing/shape.hpp"

#include <cmath>
#include <numbers>

namespace knap {
namespace {

constexpr double ball_factor = std::numbers::pi / 6.0;

double volume_of(const Sphere& sphere) { return ball_factor * sphere.diameter * sphere.diameter * sphere.diameter; }
double volume_of(const Ellipsoid& ellipsoid) { return ball_factor * ellipsoid.diameters.prod(); }
double volume_of(const Box& box) { return box.lengths.prod(); }

Vec3 extent_of(const Sphere& sphere) { return Vec3::Constant(sphere.diameter); }
Vec3 extent_of(const Ellipsoid& ellipsoid) { return ellipsoid.diameters; }
Vec3 extent_of(const Box& box) { return box.lengths; }

Shape scaled_of(const Sphere& sphere, double factor) { return Sphere{factor * sphere.diameter}; }
Shape scaled_of(const Ellipsoid& ellipsoid, double factor) { return Ellipsoid{factor * ellipsoid.diameters}; }
Shape scaled_of(const Box& box, double factor) { return Box{factor * box.lengths}; }

Vec3 snapped(const Sphere& sphere, const Vec3& x) { return x * (0.5 * sphere.diameter / x.norm()); }

// Along the ray from the centre: a surface vertex is off by round-off only, so the nearest point would be the same.
Vec3 snapped(const Ellipsoid& ellipsoid, const Vec3& x) {
  return x * (0.5 / x.cwiseQuotient(ellipsoid.diameters).norm());
}

// A coordinate within round-off of a face moves onto the face; the others stay.
Vec3 snapped(const Box& box, const Vec3& x) {
  Vec3 y = x;
  for (int k = 0; k < 3; ++k) {
    const double half = 0.5 * box.lengths[k];
    if (std::abs(std::abs(x[k]) - half) < 1e-9 * box.lengths.maxCoeff()) y[k] = std::copysign(half, x[k]);
  }
  return y;
}

}  // namespace

double volume(const Shape& shape) {
  return std::visit([](const auto& s) { return volume_of(s); }, shape);
}

Vec3 extent(const Shape& shape) {
  return std::visit([](const auto& s) { return extent_of(s); }, shape);
}

Shape scaled(const Shape& shape, double factor) {
  return std::visit([&](const auto& s) { return scaled_of(s, factor); }, shape);
}

Vec3 snapped_to_surface(const Shape& shape, const Vec3& x) {
  return std::visit([&](const auto& s) { return snapped(s, x); }, shape);
}

}  // namespace knap
