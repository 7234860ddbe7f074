#include "analysis/fit.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <nlopt.hpp>
#include <stdexcept>

namespace knap {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
// Values so close to an end of their range, over its width, are at the end.
constexpr double end_width = 1e-4;

// Parameters are looked for between 0 and 1.
double from_unit(const FitParameter& p, double u) {
  return p.is_logarithmic ? p.low * std::pow(p.high / p.low, u) : p.low + u * (p.high - p.low);
}
double to_unit(const FitParameter& p, double value) {
  const double u =
      p.is_logarithmic ? std::log(value / p.low) / std::log(p.high / p.low) : (value - p.low) / (p.high - p.low);
  return std::clamp(u, 0.0, 1.0);
}

std::vector<double> from_unit(const std::vector<FitParameter>& parameters, const std::vector<double>& unit) {
  std::vector<double> values;
  for (std::size_t i = 0; i < unit.size(); ++i) values.push_back(from_unit(parameters[i], unit[i]));
  return values;
}

struct Search {
  const std::vector<FitParameter>& parameters;
  const Loss& loss;

  double at(const std::vector<double>& unit) const {
    const double value = loss(from_unit(parameters, unit));
    return std::isfinite(value) ? value : std::numeric_limits<double>::max();
  }
};

double loss_of(const std::vector<double>& unit, std::vector<double>&, void* search) {
  return static_cast<const Search*>(search)->at(unit);
}

/// When to stop: the step over the width of the ranges, the change of the loss over the loss.
struct Tolerance {
  double step = 1e-9, loss = 1e-13;
};

std::vector<double> searched(nlopt::algorithm algorithm, Search& search, std::vector<double> unit, int most_looks,
                             const Tolerance& tolerance = {}) {
  nlopt::opt optimiser(algorithm, static_cast<unsigned>(unit.size()));
  optimiser.set_min_objective(loss_of, &search);
  optimiser.set_lower_bounds(0.0);
  optimiser.set_upper_bounds(1.0);
  optimiser.set_xtol_abs(tolerance.step);
  optimiser.set_ftol_rel(tolerance.loss);
  optimiser.set_maxeval(most_looks);
  if (algorithm == nlopt::LN_SBPLX) optimiser.set_initial_step(0.02);
  double value = 0.0;
  try {
    optimiser.optimize(unit, value);
  } catch (const nlopt::roundoff_limited&) {  // as near as doubles allow: `unit` is the best seen
  }
  return unit;
}

std::vector<double> minimum(Search& search) {
  const auto n = static_cast<int>(search.parameters.size());
  std::vector<double> unit(search.parameters.size(), 0.5);
  unit = searched(nlopt::GN_DIRECT_L, search, unit, 1000 * n);
  for (int i = 0; i < 3; ++i) unit = searched(nlopt::LN_SBPLX, search, unit, 4000 * n);
  return unit;
}

// Second derivatives by the parameters themselves, by central differences.
Eigen::MatrixXd second_derivatives(const Search& search, const std::vector<double>& unit, double step) {
  const auto n = static_cast<Eigen::Index>(unit.size());
  std::vector<double> at = unit;
  for (double& u : at) u = std::clamp(u, 2.0 * step, 1.0 - 2.0 * step);
  const auto moved = [&](Eigen::Index i, double a, Eigen::Index j, double b) {
    std::vector<double> there = at;
    there[static_cast<std::size_t>(i)] += a * step;
    there[static_cast<std::size_t>(j)] += b * step;
    return search.at(there);
  };
  Eigen::MatrixXd by_unit(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      by_unit(i, j) = i == j ? (moved(i, 1, i, 0) - 2.0 * search.at(at) + moved(i, -1, i, 0)) / (step * step)
                             : (moved(i, 1, j, 1) - moved(i, 1, j, -1) - moved(i, -1, j, 1) + moved(i, -1, j, -1)) /
                                   (4.0 * step * step);
  Eigen::VectorXd unit_by_value(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const FitParameter& p = search.parameters[static_cast<std::size_t>(i)];
    const double value = from_unit(p, at[static_cast<std::size_t>(i)]);
    unit_by_value[i] = p.is_logarithmic ? 1.0 / (value * std::log(p.high / p.low)) : 1.0 / (p.high - p.low);
  }
  return unit_by_value.asDiagonal() * by_unit * unit_by_value.asDiagonal();
}

// `scale` times the inverse of the second derivatives is the covariance.
Fit finished(Search& search, const std::vector<double>& unit, double scale, std::size_t num_data) {
  const auto n = static_cast<Eigen::Index>(unit.size());
  Fit fit{.parameters = search.parameters,
          .values = from_unit(search.parameters, unit),
          .errors = std::vector<double>(unit.size(), nan),
          .covariance = {},
          .is_at_end = {},
          .is_kinked = std::vector<bool>(unit.size(), false),
          .loss = search.at(unit),
          .num_data = num_data};
  for (const double u : unit) fit.is_at_end.push_back(u < end_width || u > 1.0 - end_width);
  if (std::find(fit.is_at_end.begin(), fit.is_at_end.end(), true) != fit.is_at_end.end()) return fit;
  constexpr double step = 2e-4, much = 2.0;
  const Eigen::MatrixXd curvature = second_derivatives(search, unit, step);
  const Eigen::VectorXd closer = second_derivatives(search, unit, 0.25 * step).diagonal();
  for (Eigen::Index i = 0; i < n; ++i)  // at a kink the quotient grows as the step shrinks
    fit.is_kinked[static_cast<std::size_t>(i)] = !(closer[i] < much * curvature(i, i));
  const Eigen::LLT<Eigen::MatrixXd> factors(curvature);
  if (factors.info() != Eigen::Success || !(scale > 0.0)) return fit;
  fit.covariance = scale * factors.solve(Eigen::MatrixXd::Identity(n, n));
  for (Eigen::Index i = 0; i < n; ++i)
    if (!fit.is_kinked[static_cast<std::size_t>(i)])
      fit.errors[static_cast<std::size_t>(i)] = std::sqrt(fit.covariance(i, i));
  return fit;
}

Loss squares_of(const Law& law, std::span<const double> data) {
  return [&law, data](std::span<const double> values) {
    double sum = 0.0;
    for (std::size_t i = 0; i < data.size(); ++i) {
      const double difference = law(values, i) - data[i];
      sum += difference * difference;
    }
    return sum;
  };
}

std::size_t index_of(const Fit& fit, const std::string& name) {
  const auto found =
      std::find_if(fit.parameters.begin(), fit.parameters.end(), [&](const FitParameter& p) { return p.name == name; });
  if (found == fit.parameters.end()) throw std::out_of_range("fit: no parameter " + name);
  return static_cast<std::size_t>(found - fit.parameters.begin());
}

}  // namespace

double Fit::value(const std::string& name) const { return values[index_of(*this, name)]; }
double Fit::error(const std::string& name) const { return errors[index_of(*this, name)]; }

Fit least_squares_fit(const std::vector<FitParameter>& parameters, const Law& law, std::span<const double> data) {
  if (data.size() < parameters.size())
    throw std::invalid_argument(fmt::format("fit: {} data for {} parameters", data.size(), parameters.size()));
  const Loss loss = squares_of(law, data);
  Search search{parameters, loss};
  const std::vector<double> unit = minimum(search);
  const auto freedom = static_cast<double>(data.size() - parameters.size());
  return finished(search, unit, freedom > 0.0 ? 2.0 * search.at(unit) / freedom : 0.0, data.size());
}

std::vector<double> refit(const std::vector<FitParameter>& parameters, const Law& law, std::span<const double> data,
                          std::vector<double> guess) {
  const Loss loss = squares_of(law, data);
  Search search{parameters, loss};
  for (std::size_t i = 0; i < guess.size(); ++i) guess[i] = to_unit(parameters[i], guess[i]);
  constexpr Tolerance coarse{.step = 1e-5, .loss = 1e-9};  // far below what drawing anew does
  return from_unit(parameters, searched(nlopt::LN_SBPLX, search, guess, 1000, coarse));
}

Fit probability_fit(const std::vector<FitParameter>& parameters, const Law& probability,
                    const std::vector<bool>& outcomes) {
  constexpr double least = 1e-9;  // an impossible outcome costs much, not everything
  const Loss loss = [&](std::span<const double> values) {
    double sum = 0.0;
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
      const double p = std::clamp(probability(values, i), least, 1.0 - least);
      sum -= std::log(outcomes[i] ? p : 1.0 - p);
    }
    return sum;
  };
  return likelihood_fit(parameters, loss, outcomes.size());
}

Fit likelihood_fit(const std::vector<FitParameter>& parameters, const Loss& loss, std::size_t num_data) {
  Search search{parameters, loss};
  const std::vector<double> unit = minimum(search);
  return finished(search, unit, 1.0, num_data);
}

double rms_residual(const Law& law, std::span<const double> values, std::span<const double> data) {
  return data.empty() ? 0.0 : std::sqrt(squares_of(law, data)(values) / static_cast<double>(data.size()));
}

}  // namespace knap
