#include "analysis/statistics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>

namespace knap {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// std::uniform_int_distribution differs between libraries; this one does not.
std::size_t below(std::mt19937_64& random, std::size_t size) { return static_cast<std::size_t>(random() % size); }

}  // namespace

double mean(std::span<const double> values) {
  return values.empty() ? nan : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double standard_deviation(std::span<const double> values) {
  if (values.size() < 2) return nan;
  const double middle = mean(values);
  double squares = 0.0;
  for (const double value : values) squares += (value - middle) * (value - middle);
  return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

double quantile(std::vector<double> values, double part) {
  if (values.empty()) throw std::invalid_argument("quantile: no values");
  std::sort(values.begin(), values.end());
  const double rank = part * static_cast<double>(values.size() - 1);
  const auto below_rank = static_cast<std::size_t>(rank);
  const std::size_t above_rank = std::min(below_rank + 1, values.size() - 1);
  const double t = rank - static_cast<double>(below_rank);
  if (values[below_rank] == values[above_rank]) return values[below_rank];  // also where both are infinite
  return (1.0 - t) * values[below_rank] + t * values[above_rank];
}

Interval central_95(const std::vector<double>& values) {
  std::vector<double> finite;
  std::copy_if(values.begin(), values.end(), std::back_inserter(finite), [](double x) { return std::isfinite(x); });
  if (finite.empty()) return {nan, nan};
  return {quantile(finite, 0.025), quantile(finite, 0.975)};
}

std::vector<std::vector<std::size_t>> bootstrap_picks(std::size_t size, int samples, std::uint64_t seed) {
  std::vector<std::size_t> all(size);
  std::iota(all.begin(), all.end(), std::size_t{0});
  return bootstrap_picks({all}, samples, seed);
}

std::vector<std::vector<std::size_t>> bootstrap_picks(const std::vector<std::vector<std::size_t>>& groups, int samples,
                                                      std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<std::vector<std::size_t>> picks(static_cast<std::size_t>(samples));
  for (auto& pick : picks)
    for (const auto& group : groups)
      for (std::size_t i = 0; i < group.size(); ++i) pick.push_back(group[below(random, group.size())]);
  return picks;
}

Interval mean_interval(std::span<const double> values) {
  if (values.size() < 2) return {nan, nan};
  // Student's t at 97.5 % for 1 to 8 degrees of freedom: so few values say too little of their own distribution.
  constexpr std::array t{12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306};
  if (values.size() - 2 < t.size()) {
    const double half =
        t[values.size() - 2] * standard_deviation(values) / std::sqrt(static_cast<double>(values.size()));
    return {mean(values) - half, mean(values) + half};
  }
  std::vector<double> means;
  for (const auto& pick : bootstrap_picks(values.size())) {
    double sum = 0.0;
    for (const std::size_t i : pick) sum += values[i];
    means.push_back(sum / static_cast<double>(values.size()));
  }
  return central_95(means);
}

}  // namespace knap
