#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace knap {

struct Interval {
  double low = 0.0, high = 0.0;
  bool contains(double x) const { return low <= x && x <= high; }
};

double mean(std::span<const double> values);
/// Of the sample, over n - 1; NaN for fewer than two.
double standard_deviation(std::span<const double> values);
/// The value below which a `part` of the sorted values lies, between ranks linearly. Throws std::invalid_argument for
/// none.
double quantile(std::vector<double> values, double part);
/// From the 2.5 to the 97.5 % quantile. Values that are not finite are left out; NaN if none is left.
Interval central_95(const std::vector<double>& values);

inline constexpr int bootstrap_samples = 1000;

/// Draws of a sample anew from itself, with replacement, always the same ones (Efron 1979): picks[k] are the indices
/// of draw k.
std::vector<std::vector<std::size_t>> bootstrap_picks(std::size_t size, int samples = bootstrap_samples,
                                                      std::uint64_t seed = 1);
/// The same for data in groups: each group is drawn from itself.
std::vector<std::vector<std::size_t>> bootstrap_picks(const std::vector<std::vector<std::size_t>>& groups, int samples,
                                                      std::uint64_t seed = 1);

/// Of the mean, 95 %: percentile bootstrap, below ten values Student's. NaN for fewer than two.
Interval mean_interval(std::span<const double> values);

}  // namespace knap
