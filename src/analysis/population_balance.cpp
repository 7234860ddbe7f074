#include "analysis/population_balance.hpp"

#include <algorithm>
#include <cmath>

namespace knap {

double breakage_distribution(double z, double q, double r) {
  if (z <= 0.0) return 0.0;
  if (z >= 1.0) return 1.0;
  const auto step = [r](double at) { return 1.0 + std::tanh((at - r) / r); };
  return std::pow(z, q) * step(z) / step(1.0);
}

Fit fit_breakage_distribution(std::span<const double> z, std::span<const double> finer) {
  return least_squares_fit(
      {{"q", "-", 0.01, 10.0, true}, {"r", "-", 0.02, 20.0, true}},
      [&](std::span<const double> p, std::size_t i) { return breakage_distribution(z[i], p[0], p[1]); }, finer);
}

double austin_distribution(double z, double phi, double g, double b) {
  if (z <= 0.0) return 0.0;
  return z >= 1.0 ? 1.0 : phi * std::pow(z, g) + (1.0 - phi) * std::pow(z, b);
}

Fit fit_austin(std::span<const double> z, std::span<const double> finer) {
  return least_squares_fit(
      {{"phi", "-", 0.0, 1.0}, {"g", "-", 0.02, 3.0, true}, {"b", "-", 0.5, 50.0, true}},
      [&](std::span<const double> p, std::size_t i) { return austin_distribution(z[i], p[0], p[1], p[2]); }, finer);
}

double measured_distribution(double z, std::span<const double> at, std::span<const double> finer) {
  if (z <= 0.0) return 0.0;
  if (z >= 1.0) return 1.0;
  const auto above = static_cast<std::size_t>(std::upper_bound(at.begin(), at.end(), z) - at.begin());
  const std::size_t i = std::clamp<std::size_t>(above, 1, at.size() - 1);
  if (finer[i - 1] <= 0.0)  // nothing so fine: no power law
    return std::max(0.0, finer[i] * (z - at[i - 1]) / (at[i] - at[i - 1]));
  const double slope = std::log(finer[i] / finer[i - 1]) / std::log(at[i] / at[i - 1]);
  return std::min(1.0, finer[i - 1] * std::pow(z / at[i - 1], slope));
}

Eigen::MatrixXd breakage_matrix(const SizeClasses& classes, const std::function<double(double z)>& distribution) {
  const auto n = static_cast<Eigen::Index>(classes.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const double parent = classes.edges[static_cast<std::size_t>(j)];
    const auto finer = [&](Eigen::Index i) {  // than the upper edge of class i; nothing is finer than the pan
      return i == j ? 1.0 : i < n ? distribution(classes.edges[static_cast<std::size_t>(i)] / parent) : 0.0;
    };
    for (Eigen::Index i = j; i < n; ++i) matrix(i, j) = finer(i) - finer(i + 1);
  }
  return matrix;
}

Eigen::VectorXd ground(const Eigen::VectorXd& masses, const Eigen::VectorXd& selection,
                       const Eigen::MatrixXd& breakage) {
  const Eigen::VectorXd selected = selection.cwiseProduct(masses);
  return masses - selected + breakage * selected;
}

}  // namespace knap
