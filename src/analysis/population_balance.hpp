#pragma once
// Breakage as a population balance takes it: selection S(x, W) and breakage B(x|y), on classes of size.
#include <Eigen/Core>
#include <span>
#include <vector>

#include "analysis/fit.hpp"

namespace knap {

/// B(x|y) = 1/2 (x/y)^q (1 + tanh((x - x')/x')) divided by its value at x = y, so that B(y|y) = 1; x' a part `r` of y,
/// so that particles of all sizes break alike. 0 <= z = x/y; 1 from z = 1 on.
double breakage_distribution(double z, double q, double r);
/// "q" and "r" by least squares of B over z = x/y, 0 < z <= 1.
Fit fit_breakage_distribution(std::span<const double> z, std::span<const double> finer);

/// B = phi z^g + (1 - phi) z^b (Austin, Klimpel & Luckie 1984): "phi", "g" of the fines, "b" of the coarse pieces.
Fit fit_austin(std::span<const double> z, std::span<const double> finer);
double austin_distribution(double z, double phi, double g, double b);

/// Between measured points of B over z, ascending in z, by straight lines of the logarithms; below the least by the
/// power law of the two least. 1 from z = 1 on.
double measured_distribution(double z, std::span<const double> at, std::span<const double> finer);

/// Classes of size, the coarsest first: class i holds what passes edges[i] and not edges[i + 1]; the last one, the pan,
/// all that passes the last edge.
struct SizeClasses {
  std::vector<double> edges;  ///< descending [m]
  std::size_t size() const { return edges.size(); }
};

/// Column j: where the broken mass of class j goes, by B(x|y) with y = edges[j]. Columns sum to 1.
Eigen::MatrixXd breakage_matrix(const SizeClasses& classes, const std::function<double(double z)>& distribution);
/// One step of grinding: m - S m + b S m for masses m and the selection of each class.
Eigen::VectorXd ground(const Eigen::VectorXd& masses, const Eigen::VectorXd& selection,
                       const Eigen::MatrixXd& breakage);

}  // namespace knap
