#include "analysis/weibull_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>

namespace knap {
namespace {

// sum x^m ln x / sum x^m - 1/m - mean ln x of the derivative of the likelihood: rises with m and is zero at its
// maximum. In logarithms relative to the largest, so that no power overflows.
double score(std::span<const double> logs, double modulus) {
  double weights = 0.0, weighted = 0.0, sum = 0.0;
  for (const double log : logs) {
    const double weight = std::exp(modulus * log);
    weights += weight;
    weighted += weight * log;
    sum += log;
  }
  return weighted / weights - 1.0 / modulus - sum / static_cast<double>(logs.size());
}

double likeliest_modulus(std::span<const double> logs) {
  double low = 1e-6, high = 1.0;
  while (score(logs, high) < 0.0) low = high, high *= 2.0;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (score(logs, middle) < 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

WeibullFit fit_weibull(std::span<const double> samples) {
  const auto fits = [](double x) { return std::isfinite(x) && x > 0.0; };
  if (samples.size() < 2 || !std::all_of(samples.begin(), samples.end(), fits))
    throw std::invalid_argument("fit_weibull: needs at least two samples, positive and finite");
  const auto [least, largest] = std::minmax_element(samples.begin(), samples.end());
  constexpr double inf = std::numeric_limits<double>::infinity();
  if (*least == *largest) return {inf, *largest, inf};
  std::vector<double> logs;
  for (const double x : samples) logs.push_back(std::log(x / *largest));
  const double m = likeliest_modulus(logs);
  const double n = static_cast<double>(samples.size());
  const double sum = std::accumulate(logs.begin(), logs.end(), 0.0,
                                     [&](double total, double log) { return total + std::exp(m * log); });
  return {m, *largest * std::pow(sum / n, 1.0 / m), m * std::sqrt(6.0 / n) / std::numbers::pi};
}

std::vector<RankedSample> ranked(std::span<const double> samples) {
  std::vector<double> sorted(samples.begin(), samples.end());
  std::sort(sorted.begin(), sorted.end());
  std::vector<RankedSample> result;
  for (std::size_t i = 0; i < sorted.size(); ++i)
    result.push_back({sorted[i], (static_cast<double>(i) + 0.5) / static_cast<double>(sorted.size())});
  return result;
}

}  // namespace knap
