#include "analysis/compression.hpp"

#include <algorithm>
#include <cstddef>

namespace knap {
namespace {

constexpr double strength_factor = 0.9;  // Hiramatsu & Oka 1966
constexpr double least_share_of_largest = 0.1;

}  // namespace

std::vector<double> smoothed_force(const ForceCurve& curve, double window) {
  std::vector<double> force(curve.time.size(), 0.0);
  std::size_t first = 0;
  for (std::size_t i = 1; i < force.size(); ++i) {
    while (first + 1 < i && curve.time[first + 1] <= curve.time[i] - window) ++first;
    // Before the first row there was no force.
    const double span = std::max(curve.time[i] - curve.time[first], first == 0 ? window : 0.0);
    if (span > 0.0) force[i] = (curve.impulse[i] - curve.impulse[first]) / span;
  }
  return force;
}

FractureForce fracture_force(const ForceCurve& curve, const std::vector<double>& force, double share, double diameter) {
  FractureForce result;
  if (force.empty()) return result;
  const double least = least_share_of_largest * *std::max_element(force.begin(), force.end());
  std::size_t top = 0;
  for (std::size_t i = 1; i < force.size() && !result.has_dropped; ++i) {
    if (force[i] > force[top]) top = i;
    result.has_dropped = force[top] > 0.0 && force[top] >= least && force[i] < share * force[top];
  }
  if (force[top] <= 0.0) return {};
  result.force = force[top];
  result.displacement = curve.displacement[top];
  result.time = curve.time[top];
  result.strength = strength_factor * result.force / (diameter * diameter);
  return result;
}

}  // namespace knap
