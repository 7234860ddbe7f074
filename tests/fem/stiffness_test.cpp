#include "fem/stiffness.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "core/parallel.hpp"
#include "tests/fem/grid_mesh.hpp"
#include "tests/fem/plain_elastic.hpp"

namespace knap {
namespace {

const Material material = make_material(1.0, 0.3, 1.0);

struct Body {
  TetMesh mesh;
  Topology topology;
  std::vector<Vec4> x;

  SparseMatrix stiffness() const {
    SparseMatrix k = stiffness_pattern(topology);
    update_stiffness(k, topology, mesh.vertices, material, x);
    return k;
  }
  std::vector<Vec4> forces(const Eigen::VectorXd& u) const {
    return plain_forces(topology, mesh.vertices, material, displaced(u));
  }
  double energy(const Eigen::VectorXd& u) const {
    return plain_energy(topology, mesh.vertices, material, displaced(u));
  }
  std::vector<Vec4> displaced(const Eigen::VectorXd& u) const {
    std::vector<Vec4> y = x;
    for (Index i = 0; i < to_index(y.size()); ++i) xyz(y[at(i)]) += u.segment<3>(3 * i);
    return y;
  }
};

Eigen::VectorXd random_vector(Index size, double amplitude, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(-amplitude, amplitude);
  return Eigen::VectorXd::NullaryExpr(size, [&] { return value(random); });
}

Eigen::VectorXd flat(const std::vector<Vec4>& nodal) {
  Eigen::VectorXd u(3 * to_index(nodal.size()));
  for (Index i = 0; i < to_index(nodal.size()); ++i) u.segment<3>(3 * i) = xyz(nodal[at(i)]);
  return u;
}

// A cube of n cells an edge, cracked along some facets, with every node moved by up to `amplitude`.
Body make_body(Index n, double amplitude) {
  Body body{grid_mesh(n, 1.0, 0.15), {}, {}};
  body.topology = make_topology(body.mesh);
  for (const Vec3& v : body.mesh.vertices) body.x.push_back(padded(v));
  for (const Index corner : body.topology.corners_of_vertex[0]) {  // two nodes at vertex 0
    if ((corner >> 2) % 2 == 0) continue;
    if (body.x.size() == body.mesh.vertices.size()) {
      body.x.push_back(body.x[0]);
      body.topology.vertex_of_node.push_back(0);
    }
    body.topology.tet_nodes[at(corner >> 2)][at(corner & 3)] = body.topology.num_nodes() - 1;
  }
  const Eigen::VectorXd moved = random_vector(3 * to_index(body.x.size()), amplitude, 3);
  body.x = body.displaced(moved);
  return body;
}

TEST(Stiffness, IsTheDerivativeOfTheForces) {
  const Body body = make_body(3, 0.05);
  ASSERT_GT(body.x.size(), body.mesh.vertices.size());
  const SparseMatrix k = body.stiffness();
  const double h = 1e-5;
  for (unsigned seed = 0; seed < 8; ++seed) {
    const Eigen::VectorXd u = random_vector(3 * body.topology.num_nodes(), 1.0, seed);
    const Eigen::VectorXd slope = (flat(body.forces(h * u)) - flat(body.forces(-h * u))) / (2.0 * h);
    const Eigen::VectorXd product = symmetric_product(k, u);
    EXPECT_LT((product + slope).norm(), 1e-8 * product.norm()) << seed;  // the forces are cubic: h^2 of the third order
  }
}

TEST(Stiffness, IsTheSecondDerivativeOfTheEnergy) {
  const Body body = make_body(2, 0.05);
  const SparseMatrix k = body.stiffness();
  const double h = 1e-3;
  const double here = body.energy(0.0 * flat(body.x));
  for (unsigned seed = 0; seed < 8; ++seed) {
    const Eigen::VectorXd u = random_vector(3 * body.topology.num_nodes(), 1.0, seed);
    const double second = (body.energy(h * u) - 2.0 * here + body.energy(-h * u)) / (h * h);
    EXPECT_NEAR(u.dot(symmetric_product(k, u)), second, 1e-4 * std::abs(second)) << seed;  // O(h^2) of the fourth order
  }
}

TEST(Stiffness, EveryEntryIsTheDerivativeOfOneForce) {
  const Body body = make_body(1, 0.1);
  const Eigen::MatrixXd k = body.stiffness();
  const double h = 1e-5;
  for (Eigen::Index j = 0; j < k.cols(); ++j) {
    const Eigen::VectorXd u = h * Eigen::VectorXd::Unit(k.cols(), j);
    const Eigen::VectorXd slope = (flat(body.forces(u)) - flat(body.forces(-u))) / (2.0 * h);
    for (Eigen::Index i = j; i < k.rows(); ++i) EXPECT_NEAR(k(i, j), -slope(i), 1e-9) << i << ' ' << j;
  }
}

TEST(Stiffness, RigidMotionsOfABodyAtRestCostNothing) {
  const Body body = make_body(4, 0.0);
  const SparseMatrix k = body.stiffness();
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::VectorXd shift(k.rows()), turn(k.rows());
    for (Index i = 0; i < body.topology.num_nodes(); ++i) {
      shift.segment<3>(3 * i) = Vec3::Unit(axis);
      turn.segment<3>(3 * i) = Vec3::Unit(axis).cross(Vec3(xyz(body.x[at(i)])));
    }
    EXPECT_LT(symmetric_product(k, shift).cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_LT(symmetric_product(k, turn).cwiseAbs().maxCoeff(), 1e-14);
  }
}

TEST(Stiffness, SameBitsForAnyNumberOfThreads) {
  const Body body = make_body(9, 0.01);
  set_num_threads(1);
  const SparseMatrix one = body.stiffness();
  for (const int threads : {2, 5}) {
    set_num_threads(threads);
    const SparseMatrix many = body.stiffness();
    ASSERT_EQ(many.nonZeros(), one.nonZeros());
    EXPECT_EQ(std::memcmp(many.valuePtr(), one.valuePtr(), sizeof(double) * static_cast<std::size_t>(one.nonZeros())),
              0);
  }
}

}  // namespace
}  // namespace knap
