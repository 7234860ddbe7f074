// Lanczos iteration (Spectra) on the inverse of K + s M, whose largest eigenvalues 1/(omega^2 + s) are the lowest
// modes: shift-invert with a shift just below zero, so that the stiffness of a free body, singular for its rigid
// motions, has a factor. In the coordinates y = M^(1/2) u everything is symmetric and modes are orthonormal. The rigid
// motions are known and projected out. A Krylov space holds one vector of each eigenspace only, so of several modes
// with the same frequency some may be missed; what has been found is therefore projected out too and the lowest of the
// rest looked for, until that lies above.
#include "quasistatic/modes.hpp"

#include <Spectra/SymEigsSolver.h>
#include <fmt/format.h>

#include <numbers>

#include "core/errors.hpp"
#include "quasistatic/sparse_cholesky.hpp"

namespace knap {
namespace {

constexpr Index num_rigid = 6;
// s over (c_s/extent)^2; the lowest mode of a sphere has omega^2 = 25 of these.
constexpr double relative_shift = 1e-2;
constexpr Index smallest_krylov_space = 24;
constexpr Index most_restarts = 500;
// Two squared frequencies nearer than this are the same as far as a missed mode goes [-].
constexpr double same_eigenvalue = 1e-8;

// y -> s P M^(1/2) (K + s M)^-1 M^(1/2) P y with P the projection away from the locked vectors, as Spectra wants it.
class InverseOperator {
 public:
  using Scalar = double;

  InverseOperator(const VibratingBody& body, double shift) : shift_(shift), roots_(3 * body.topology.num_nodes()) {
    for (Index i = 0; i < body.topology.num_nodes(); ++i)
      roots_.segment<3>(3 * i).setConstant(std::sqrt(body.masses[at(i)]));
    SparseMatrix stiffness = stiffness_pattern(body.topology);
    std::vector<Vec4> x;
    for (const Index vertex : body.topology.vertex_of_node) x.push_back(padded(body.reference_positions[at(vertex)]));
    update_stiffness(stiffness, body.topology, body.reference_positions, body.material, x);
    for (Eigen::Index i = 0; i < stiffness.cols(); ++i)
      stiffness.valuePtr()[stiffness.outerIndexPtr()[i]] += shift * roots_[i] * roots_[i];  // the diagonal comes first
    cholesky_ = std::make_unique<SparseCholesky>(stiffness);
    if (!cholesky_->factorise(stiffness)) throw RuntimeFailure("modes: the stiffness is not positive definite");
    lock_rigid_motions(x);
  }

  Eigen::Index rows() const { return roots_.size(); }
  Eigen::Index cols() const { return roots_.size(); }
  void perform_op(const double* in, double* out) const {
    const Eigen::VectorXd y = projected(Eigen::Map<const Eigen::VectorXd>(in, rows()));
    Eigen::Map<Eigen::VectorXd>(out, rows()) =
        projected(shift_ * roots_.cwiseProduct(cholesky_->solve(roots_.cwiseProduct(y))));
  }

  Eigen::VectorXd projected(Eigen::VectorXd y) const {
    y -= locked_ * (locked_.transpose() * y);
    return y;
  }
  /// Projects an orthonormal vector out from now on.
  void lock(const Eigen::VectorXd& y) {
    locked_.conservativeResize(rows(), locked_.cols() + 1);
    locked_.rightCols(1) = y;
  }
  const Eigen::VectorXd& roots() const { return roots_; }

 private:
  void lock_rigid_motions(std::span<const Vec4> x) {
    Vec3 centre = Vec3::Zero();
    for (const Vec4& position : x) centre += xyz(position) / static_cast<double>(x.size());
    Eigen::MatrixXd motions(rows(), Eigen::Index{num_rigid});
    for (int axis = 0; axis < 3; ++axis)
      for (Index i = 0; i < to_index(x.size()); ++i) {
        const Vec3 arm = xyz(x[at(i)]) - centre;
        motions.col(axis).segment<3>(3 * i) = roots_[3 * i] * Vec3::Unit(axis);
        motions.col(3 + axis).segment<3>(3 * i) = roots_[3 * i] * Vec3::Unit(axis).cross(arm);
      }
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(motions.colwise().normalized());
    locked_ = qr.householderQ() * Eigen::MatrixXd::Identity(rows(), num_rigid);
  }

  double shift_;            // s [1/s2]
  Eigen::VectorXd roots_;   // of the masses, by unknown
  Eigen::MatrixXd locked_;  // orthonormal
  std::unique_ptr<SparseCholesky> cholesky_;
};

struct EigenPair {
  double inverse = 0.0;  // s/(omega^2 + s)
  Eigen::VectorXd y;
};

// The `count` largest of the operator, descending.
std::vector<EigenPair> largest(const InverseOperator& op, Index count, const ModesOptions& options) {
  const Index n = to_index(static_cast<std::size_t>(op.rows()));
  const Index space = std::min(n, std::max(smallest_krylov_space, 2 * count + 1));
  InverseOperator& borrowed = const_cast<InverseOperator&>(op);  // Spectra only reads it
  Spectra::SymEigsSolver<InverseOperator> solver(borrowed, count, space);
  const Eigen::VectorXd start = op.projected(Eigen::VectorXd::LinSpaced(n, 0.0, 7.0 * n).array().sin() + 0.1);
  solver.init(start.data());
  const auto found = solver.compute(Spectra::SortRule::LargestAlge, most_restarts, options.tolerance);
  if (found < count || solver.info() != Spectra::CompInfo::Successful)
    throw RuntimeFailure(fmt::format("modes: {} of {} converged to {}", found, count, options.tolerance));
  std::vector<EigenPair> pairs;
  for (Index i = 0; i < count; ++i) pairs.push_back({solver.eigenvalues()[i], solver.eigenvectors(count).col(i)});
  return pairs;
}

// Of at least one mode each; those that the first look missed take the place of the highest.
std::vector<EigenPair> all_largest(InverseOperator& op, const ModesOptions& options) {
  std::vector<EigenPair> pairs = largest(op, options.count, options);
  for (const EigenPair& pair : pairs) op.lock(pair.y);
  for (Index left = to_index(static_cast<std::size_t>(op.rows())) - num_rigid - options.count; left > 0; --left) {
    EigenPair next = largest(op, 1, options).front();
    if (next.inverse <= (1.0 + same_eigenvalue) * pairs.back().inverse) break;
    op.lock(next.y);
    const auto place =
        std::find_if(pairs.begin(), pairs.end(), [&](const EigenPair& p) { return p.inverse < next.inverse; });
    pairs.insert(place, std::move(next));
    pairs.pop_back();
  }
  return pairs;
}

Mode mode(const EigenPair& pair, const Eigen::VectorXd& roots, double shift) {
  Mode m;
  m.frequency = std::sqrt(std::max(0.0, shift / pair.inverse - shift)) / (2.0 * std::numbers::pi);
  const Eigen::VectorXd u = pair.y.cwiseQuotient(roots);
  double largest2 = 0.0;
  Vec3 direction = Vec3::Zero();
  for (Eigen::Index i = 0; i < u.size(); i += 3) {
    m.shape.push_back(u.segment<3>(i));
    if (m.shape.back().squaredNorm() > largest2) largest2 = m.shape.back().squaredNorm(), direction = m.shape.back();
  }
  Eigen::Index axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  const double scale = std::copysign(1.0 / std::sqrt(largest2), direction[axis]);
  for (Vec3& displacement : m.shape) displacement *= scale;
  return m;
}

}  // namespace

std::vector<Mode> free_modes(const VibratingBody& body, const ModesOptions& options) {
  const Index available = 3 * body.topology.num_nodes() - num_rigid;
  if (options.count < 1 || options.count > available)
    throw InputError(fmt::format("{} modes are asked for; this mesh has 1 to {}", options.count, available));
  Vec3 low = body.reference_positions.front(), high = low;
  for (const Vec3& v : body.reference_positions) low = low.cwiseMin(v), high = high.cwiseMax(v);
  const double speed = s_wave_speed(body.material.small_strain(), body.material.density);
  const double shift = relative_shift * std::pow(speed / (high - low).maxCoeff(), 2);
  InverseOperator op(body, shift);
  std::vector<Mode> modes;
  for (const EigenPair& pair : all_largest(op, options)) modes.push_back(mode(pair, op.roots(), shift));
  return modes;
}

std::vector<int> multiplicities(std::span<const Mode> modes, double relative_gap) {
  std::vector<int> size(modes.size());
  for (std::size_t first = 0, end = 0; first < modes.size(); first = end) {
    for (end = first + 1; end < modes.size(); ++end)
      if (modes[end].frequency > (1.0 + relative_gap) * modes[end - 1].frequency) break;
    std::fill(size.begin() + static_cast<std::ptrdiff_t>(first), size.begin() + static_cast<std::ptrdiff_t>(end),
              static_cast<int>(end - first));
  }
  return size;
}

}  // namespace knap
