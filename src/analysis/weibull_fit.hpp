#pragma once
#include <span>
#include <vector>

namespace knap {

/// The distribution P(x) = 1 - exp(-(x / scale)^modulus).
struct WeibullFit {
  double modulus = 0.0;        ///< [-]; infinite for equal samples
  double scale = 0.0;          ///< in the samples' unit; 63 % are below it
  double modulus_error = 0.0;  ///< standard error of the modulus for many samples: modulus sqrt(6/n)/pi
};

/// Maximum likelihood of both parameters (Cohen 1965). Throws std::invalid_argument for fewer than two samples, or one
/// that is not positive and finite.
WeibullFit fit_weibull(std::span<const double> samples);

/// A sample with the probability that its rank among n gives it, (i - 0.5)/n.
struct RankedSample {
  double value = 0.0;
  double probability = 0.0;
};
/// Ascending.
std::vector<RankedSample> ranked(std::span<const double> samples);

}  // namespace knap
