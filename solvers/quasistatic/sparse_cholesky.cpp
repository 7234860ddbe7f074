#include "quasistatic/sparse_cholesky.hpp"

#include <cholmod.h>
#include <fmt/format.h>

#include <stdexcept>

#include "core/errors.hpp"

namespace knap {
namespace {

// CHOLMOD reads our arrays in place.
cholmod_sparse view(const SparseMatrix& lower) {
  cholmod_sparse sparse{};
  sparse.nrow = static_cast<std::size_t>(lower.rows());
  sparse.ncol = static_cast<std::size_t>(lower.cols());
  sparse.nzmax = static_cast<std::size_t>(lower.nonZeros());
  sparse.p = const_cast<Index*>(lower.outerIndexPtr());
  sparse.i = const_cast<Index*>(lower.innerIndexPtr());
  sparse.x = const_cast<double*>(lower.valuePtr());
  sparse.stype = -1;
  sparse.itype = CHOLMOD_INT;
  sparse.xtype = CHOLMOD_REAL;
  sparse.dtype = CHOLMOD_DOUBLE;
  sparse.sorted = 1;
  sparse.packed = 1;
  return sparse;
}

cholmod_dense view(const Eigen::VectorXd& b) {
  cholmod_dense dense{};
  dense.nrow = dense.nzmax = dense.d = static_cast<std::size_t>(b.size());
  dense.ncol = 1;
  dense.x = const_cast<double*>(b.data());
  dense.xtype = CHOLMOD_REAL;
  dense.dtype = CHOLMOD_DOUBLE;
  return dense;
}

}  // namespace

struct SparseCholesky::Cholmod {
  Cholmod() { cholmod_start(&common); }
  ~Cholmod() {
    cholmod_free_dense(&solution, &common);
    cholmod_free_dense(&work_y, &common);
    cholmod_free_dense(&work_e, &common);
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  Cholmod(const Cholmod&) = delete;
  Cholmod& operator=(const Cholmod&) = delete;

  void check(const char* task) const {
    if (common.status < CHOLMOD_OK)
      throw RuntimeFailure(fmt::format("{} fails: CHOLMOD status {}", task, common.status));
  }

  cholmod_common common{};
  cholmod_factor* factor = nullptr;
  cholmod_dense* solution = nullptr;  // kept, like the two work vectors, from one solve to the next
  cholmod_dense* work_y = nullptr;
  cholmod_dense* work_e = nullptr;
  FactorSize size;
  bool is_factorised = false;
};

SparseCholesky::SparseCholesky(const SparseMatrix& lower, Ordering ordering) : cholmod_(std::make_unique<Cholmod>()) {
  cholmod_common& common = cholmod_->common;
  common.print = 0;  // our callers report
  common.quick_return_if_not_posdef = 1;
  common.supernodal = CHOLMOD_SUPERNODAL;  // a factor by dense blocks, whatever its size: one way to the same bits
  common.nmethods = 1;
  common.method[0].ordering = ordering == Ordering::NestedDissection ? CHOLMOD_METIS : CHOLMOD_AMD;
  common.postorder = 1;
  cholmod_sparse matrix = view(lower);
  cholmod_->factor = cholmod_analyze(&matrix, &common);
  cholmod_->check("ordering the unknowns");
  cholmod_->size = {common.lnz, common.fl};
}

SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

bool SparseCholesky::factorise(const SparseMatrix& lower) {
  cholmod_sparse matrix = view(lower);
  cholmod_->is_factorised = false;
  cholmod_factorize(&matrix, cholmod_->factor, &cholmod_->common);
  cholmod_->check("factorising the stiffness");
  cholmod_->is_factorised = cholmod_->common.status == CHOLMOD_OK && cholmod_->factor->minor == cholmod_->factor->n;
  return cholmod_->is_factorised;
}

Eigen::VectorXd SparseCholesky::solve(const Eigen::VectorXd& b) const {
  if (!cholmod_->is_factorised) throw std::logic_error("SparseCholesky: solve without a factor");
  cholmod_dense right = view(b);
  cholmod_solve2(CHOLMOD_A, cholmod_->factor, &right, nullptr, &cholmod_->solution, nullptr, &cholmod_->work_y,
                 &cholmod_->work_e, &cholmod_->common);
  cholmod_->check("solving with the factor");
  return Eigen::Map<const Eigen::VectorXd>(static_cast<const double*>(cholmod_->solution->x), b.size());
}

FactorSize SparseCholesky::size() const { return cholmod_->size; }

}  // namespace knap
