#include "quasistatic/constrained_solver.hpp"

namespace knap {
namespace {

// The residual of the linear equations; Newton's iteration around them sees to the rest [-].
constexpr double tolerance = 1e-6;
// A factor costs as much as 50 solutions with it (sphere of 5k to 80k tets).
constexpr int iterations_of_a_factor = 50;
constexpr int most_iterations = 30;

}  // namespace

bool ConstrainedSolver::renew(const SparseMatrix& stiffness, const Eigen::VectorXd& is_free) {
  SparseMatrix constrained = stiffness;
  for (Index j = 0; j < to_index(static_cast<std::size_t>(constrained.cols())); ++j)
    for (SparseMatrix::InnerIterator entry(constrained, j); entry; ++entry)
      if (entry.row() != j) entry.valueRef() *= is_free[j] * is_free[entry.row()];
  ++factorisations_;
  iterations_ = 0;
  has_factor_ = cholesky_.factorise(constrained);
  return has_factor_;
}

ConstrainedSolver::Outcome ConstrainedSolver::iterate(const SparseMatrix& stiffness,
                                                      const LinearConstraints& constraints, Eigen::VectorXd residual,
                                                      Eigen::VectorXd& d) {
  const double goal = tolerance * residual.norm();
  Eigen::VectorXd direction = Eigen::VectorXd::Zero(residual.size());
  double last = 1.0;
  for (int i = 0; residual.norm() > goal; ++i) {
    if (i == most_iterations) return Outcome::TooSlow;
    ++iterations_;
    const Eigen::VectorXd z = constraints.project(cholesky_.solve(residual));
    const double now = residual.dot(z);
    direction = z + (i == 0 ? 0.0 : now / last) * direction;
    last = now;
    const Eigen::VectorXd product = constraints.project(symmetric_product(stiffness, direction));
    const double curvature = direction.dot(product);
    if (!(curvature > 0.0)) return Outcome::NotPositiveDefinite;
    d += now / curvature * direction;
    residual -= now / curvature * product;
  }
  return Outcome::Converged;
}

bool ConstrainedSolver::solve(const SparseMatrix& stiffness, const LinearConstraints& constraints,
                              const Eigen::VectorXd& load, Eigen::VectorXd& d) {
  d -= constraints.is_free.cwiseProduct(d);
  const Eigen::VectorXd prescribed = d;
  const Eigen::VectorXd residual = constraints.project(load - symmetric_product(stiffness, d));
  if (has_factor_ && iterations_ < iterations_of_a_factor) {
    if (iterate(stiffness, constraints, residual, d) == Outcome::Converged) return true;
    d = prescribed;
  }
  return renew(stiffness, constraints.is_free) && iterate(stiffness, constraints, residual, d) == Outcome::Converged;
}

}  // namespace knap
