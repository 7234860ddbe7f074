#include "quasistatic/sparse_cholesky.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>

#include "core/parallel.hpp"
#include "tests/fem/grid_mesh.hpp"

namespace knap {
namespace {

// The stiffness of a cube held by springs to the ground.
SparseMatrix supported_stiffness(Index cells, double spring) {
  const TetMesh mesh = grid_mesh(cells, 1.0, 0.15);
  const Topology topology = make_topology(mesh);
  std::vector<Vec4> x;
  for (const Vec3& v : mesh.vertices) x.push_back(padded(v));
  SparseMatrix k = stiffness_pattern(topology);
  update_stiffness(k, topology, mesh.vertices, make_material(1.0, 0.25, 1.0), x);
  for (Index i = 0; i < to_index(static_cast<std::size_t>(k.cols())); ++i) k.coeffRef(i, i) += spring;
  return k;
}

Eigen::VectorXd loads(Eigen::Index n) { return Eigen::VectorXd::LinSpaced(n, -1.0, 2.0).array().sin(); }

TEST(SparseCholesky, SolvesWithEitherOrdering) {
  const SparseMatrix k = supported_stiffness(6, 0.01);
  const Eigen::VectorXd b = loads(k.cols());
  for (const Ordering ordering : {Ordering::NestedDissection, Ordering::ApproximateMinDegree}) {
    SparseCholesky cholesky(k, ordering);
    EXPECT_GT(cholesky.size().nonzeros, static_cast<double>(k.nonZeros()));
    ASSERT_TRUE(cholesky.factorise(k));
    EXPECT_LT((symmetric_product(k, cholesky.solve(b)) - b).norm(), 1e-12 * b.norm());
  }
}

TEST(SparseCholesky, FactorisesOneMatrixAfterTheOther) {
  SparseMatrix k = supported_stiffness(4, 0.01);
  const Eigen::VectorXd b = loads(k.cols());
  SparseCholesky cholesky(k);
  ASSERT_TRUE(cholesky.factorise(k));
  const Eigen::VectorXd first = cholesky.solve(b);
  k *= 4.0;
  ASSERT_TRUE(cholesky.factorise(k));
  EXPECT_LT((cholesky.solve(b) - 0.25 * first).norm(), 1e-12 * first.norm());
}

TEST(SparseCholesky, SaysWhenAMatrixIsNotPositiveDefiniteAndGoesOn) {
  SparseMatrix k = supported_stiffness(4, 0.01);
  const Eigen::VectorXd b = loads(k.cols());
  SparseCholesky cholesky(k);
  EXPECT_THROW(cholesky.solve(b), std::logic_error);
  const double diagonal = k.coeff(7, 7);
  k.coeffRef(7, 7) = -1.0;
  EXPECT_FALSE(cholesky.factorise(k));
  EXPECT_THROW(cholesky.solve(b), std::logic_error);
  k.coeffRef(7, 7) = diagonal;
  ASSERT_TRUE(cholesky.factorise(k));
  EXPECT_LT((symmetric_product(k, cholesky.solve(b)) - b).norm(), 1e-12 * b.norm());
}

TEST(SparseCholesky, SameBitsForAnyNumberOfThreads) {
  const SparseMatrix k = supported_stiffness(9, 0.01);
  const Eigen::VectorXd b = loads(k.cols());
  set_num_threads(1);
  SparseCholesky one(k);
  ASSERT_TRUE(one.factorise(k));
  const Eigen::VectorXd expected = one.solve(b);
  set_num_threads(4);
  SparseCholesky many(k);
  ASSERT_TRUE(many.factorise(k));
  EXPECT_EQ(many.solve(b), expected);
}

}  // namespace
}  // namespace knap
