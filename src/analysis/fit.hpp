#pragma once
// Fits of laws with a few parameters, by NLopt: globally first (DIRECT, Gablonsky & Kelley 2001), then locally
// (subplex, Rowan 1990). Both need no derivatives, keep to bounds and give the same result every time.
#include <Eigen/Core>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace knap {

/// A parameter and where it is looked for.
struct FitParameter {
  std::string name;
  std::string unit;
  double low = 0.0, high = 1.0;
  bool is_logarithmic = false;  ///< looked for by its logarithm; needs low > 0
};

/// Values in the order of the parameters.
struct Fit {
  std::vector<FitParameter> parameters;
  std::vector<double> values;
  std::vector<double> errors;   ///< standard errors; NaN where the data leave the value open, or the loss has a kink
  Eigen::MatrixXd covariance;   ///< empty where the data leave a value open
  std::vector<bool> is_at_end;  ///< the best value lies at an end of where it was looked for
  std::vector<bool> is_kinked;  ///< the loss has no second derivative there: no standard error
  double loss = 0.0;            ///< sum of squares, or minus the logarithm of the likelihood
  std::size_t num_data = 0;

  /// Throws std::out_of_range if there is no such parameter.
  double value(const std::string& name) const;
  double error(const std::string& name) const;
};

using Loss = std::function<double(std::span<const double> values)>;
/// The response the law predicts for datum i.
using Law = std::function<double(std::span<const double> values, std::size_t i)>;

/// The least sum of squared differences to `data`; covariance 2 s^2 over its second derivatives. Throws
/// std::invalid_argument for fewer data than parameters.
Fit least_squares_fit(const std::vector<FitParameter>& parameters, const Law& law, std::span<const double> data);
/// The same from a guess: locally only, without covariance. For many fits to nearly the same data.
std::vector<double> refit(const std::vector<FitParameter>& parameters, const Law& law, std::span<const double> data,
                          std::vector<double> guess);

/// The most likely values for outcomes that happened or not, of the probability that the law predicts.
Fit probability_fit(const std::vector<FitParameter>& parameters, const Law& probability,
                    const std::vector<bool>& outcomes);
/// The most likely values for any loss = -ln(likelihood).
Fit likelihood_fit(const std::vector<FitParameter>& parameters, const Loss& loss, std::size_t num_data);

/// Root mean square of the differences between law and data.
double rms_residual(const Law& law, std::span<const double> values, std::span<const double> data);

}  // namespace knap
