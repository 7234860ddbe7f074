#pragma once
#include "quasistatic/sparse_cholesky.hpp"

namespace knap {

/// What is known of the solution beforehand.
struct LinearConstraints {
  Eigen::VectorXd is_free;  ///< by unknown: 1, or 0 where it is prescribed
  Eigen::MatrixXd still;    ///< orthonormal columns c of free unknowns: c.d = 0, by a force along c

  /// The part of a load that the constraints leave to be balanced.
  Eigen::VectorXd project(const Eigen::VectorXd& load) const {
    Eigen::VectorXd part = is_free.cwiseProduct(load);
    if (still.cols() > 0) part -= still * (still.transpose() * part);
    return part;
  }
};

/// Linear equations of which some unknowns are prescribed, and not always the same. A factor is dear, so an old one, of
/// other constraints and another stiffness, serves as the preconditioner of conjugate gradients for as long as that is
/// cheaper. When to renew it depends on counts alone, so the bits are the same on any machine.
class ConstrainedSolver {
 public:
  explicit ConstrainedSolver(const SparseMatrix& pattern) : cholesky_(pattern) {}

  /// d with K d = load up to the forces of the constraints; prescribed entries of d are given. False: K is not positive
  /// definite under these constraints.
  [[nodiscard]] bool solve(const SparseMatrix& stiffness, const LinearConstraints& constraints,
                           const Eigen::VectorXd& load, Eigen::VectorXd& d);

  int factorisations() const { return factorisations_; }

 private:
  enum class Outcome { Converged, TooSlow, NotPositiveDefinite };

  bool renew(const SparseMatrix& stiffness, const Eigen::VectorXd& is_free);
  Outcome iterate(const SparseMatrix& stiffness, const LinearConstraints& constraints, Eigen::VectorXd residual,
                  Eigen::VectorXd& d);

  SparseCholesky cholesky_;
  bool has_factor_ = false;
  int iterations_ = 0;  // since the factor was made
  int factorisations_ = 0;
};

}  // namespace knap
