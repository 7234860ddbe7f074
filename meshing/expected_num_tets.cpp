#include <algorithm>
#include <numbers>

#include "meshing/tetrahedralise.hpp"

namespace knap {
namespace {

constexpr double tets_per_cubed_edge = 10.9;  // measured: sphere, box and ellipsoid, 6k to 300k tets, 10.6 to 11.2

double inverse_cube(double x) { return 1.0 / (x * x * x); }

// Integral over the half ball around a contact point of size^-3 - element_size^-3, midpoint rule along the radius.
double refined_integral(const TetrahedraliseOptions& options) {
  const double extent = options.contact_extent;
  constexpr int intervals = 100;
  const double dr = 2.0 * extent / intervals;
  double sum = 0.0;
  for (int i = 0; i < intervals; ++i) {
    const double r = (i + 0.5) * dr;
    const double blend = std::clamp(r / extent - 1.0, 0.0, 1.0);
    const double size = (1.0 - blend) * options.contact_element_size + blend * options.element_size;
    sum += 2.0 * std::numbers::pi * r * r * dr * (inverse_cube(size) - inverse_cube(options.element_size));
  }
  return sum;
}

}  // namespace

double expected_num_tets(const Shape& shape, const TetrahedraliseOptions& options) {
  const bool refined = options.contact_element_size > 0.0 && options.contact_extent > 0.0;
  const double far = volume(shape) * inverse_cube(options.element_size);
  const auto contacts = static_cast<double>(options.contact_points.size());
  return tets_per_cubed_edge * (far + (refined ? contacts * refined_integral(options) : 0.0));
}

}  // namespace knap
