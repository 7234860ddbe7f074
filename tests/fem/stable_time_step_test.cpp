#include "fem/stable_time_step.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "fem/lumped_mass.hpp"
#include "fem/tet_reference.hpp"
#include "tests/fem/grid_mesh.hpp"

namespace knap {
namespace {

constexpr double density = 1.0;

// Largest omega^2 of the linear body, from the full stiffness matrix.
double true_frequency2(const Topology& topology, std::span<const Vec3> x, const Lame& l,
                       std::span<const double> masses) {
  const Index n = 3 * topology.num_nodes();
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
  for (Index t = 0; t < topology.num_tets(); ++t) {
    const TetReference tet = make_tet_reference(x, topology.tet_vertices[at(t)]);
    const auto g = shape_gradients(tet);
    const TetCorners& node = topology.tet_nodes[at(t)];
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j)
        K.block<3, 3>(3 * node[i], 3 * node[j]) +=
            tet.volume / std::sqrt(masses[at(node[i])] * masses[at(node[j])]) *
            (l.lambda * g[i] * g[j].transpose() + l.mu * g[j] * g[i].transpose() +
             l.mu * g[i].dot(g[j]) * Mat3::Identity());
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K, Eigen::EigenvaluesOnly).eigenvalues()[n - 1];
}

struct Ratios {
  double rigorous, plane_wave;  // bound of omega over the true largest omega
};

Ratios bound_over_true(const Topology& topology, std::span<const Vec3> x, double poisson_ratio) {
  const Material material = make_material(1.0, poisson_ratio, density);
  const auto masses = lumped_masses(topology, corner_masses(topology, tet_volumes(topology.tet_vertices, x), density));
  const double omega = std::sqrt(true_frequency2(topology, x, material.small_strain(), masses));
  const auto bound = [&](StiffnessBound kind) {
    const auto stiffness = corner_stiffnesses(topology.tet_vertices, x, material, kind);
    return 2.0 / critical_time_step(topology, stiffness, masses) / omega;
  };
  return {bound(StiffnessBound::Rigorous), bound(StiffnessBound::PlaneWave)};
}

// Every tet with nodes of its own.
Topology exploded(Topology topology) {
  topology.vertex_of_node.clear();
  for (auto& tet : topology.tet_nodes)
    for (Index& node : tet) {
      topology.vertex_of_node.push_back(node);
      node = topology.num_nodes() - 1;
    }
  return topology;
}

// The jittered cube drawn to a ball of radius 1.
TetMesh ball(Index n, double jitter, unsigned seed = 1) {
  TetMesh mesh = grid_mesh(n, 2.0, jitter, seed);
  for (Vec3& v : mesh.vertices) {
    v -= Vec3::Ones();
    const double largest = v.cwiseAbs().maxCoeff();
    if (largest > 0.0) v *= largest / v.norm() * 0.6 + 0.4;
  }
  std::erase_if(mesh.tets, [&](const TetCorners& t) {
    return make_tet_reference(mesh.vertices, t).volume < 1e-3 / static_cast<double>(n * n * n);
  });
  return mesh;
}

void expect_rigorous(const char* what, const Topology& topology, std::span<const Vec3> x) {
  for (const double nu : {0.0, 0.2, 0.3, 0.45}) {
    const Ratios r = bound_over_true(topology, x, nu);
    EXPECT_GE(r.rigorous, 1.0 - 1e-12) << what << " nu " << nu;
  }
}

TEST(StableTimeStep, BoundsTheTrueFrequencyOfAnyBody) {
  for (const Index n : {2, 3, 4, 5}) {
    const TetMesh cube = grid_mesh(n, 1.0, 0.18), sphere = ball(n, 0.1);
    expect_rigorous("cube", make_topology(cube), cube.vertices);
    expect_rigorous("ball", make_topology(sphere), sphere.vertices);
  }
}

TEST(StableTimeStep, BoundIsExactForADilatingRegularTet) {
  const TetMesh mesh{{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {{0, 2, 1, 3}}};
  ASSERT_GT(tet_volume(mesh, 0), 0.0);
  const Ratios r = bound_over_true(make_topology(mesh), mesh.vertices, 0.25);
  EXPECT_NEAR(r.rigorous, 1.0, 1e-12);
  EXPECT_NEAR(r.plane_wave, std::sqrt(0.6), 1e-12);  // (lambda + 2 mu)/(3 lambda + 2 mu): not a bound here
  expect_rigorous("regular tet", make_topology(mesh), mesh.vertices);
}

TEST(StableTimeStep, BoundsSeparateTetsAndPartlySplitBodies) {
  const TetMesh mesh = grid_mesh(2, 1.0, 0.18);
  expect_rigorous("exploded", exploded(make_topology(mesh)), mesh.vertices);
  Topology topology = make_topology(mesh);
  for (Index v = 0; v < topology.num_vertices(); v += 2) {
    topology.vertex_of_node.push_back(v);
    for (const Index corner : topology.corners_of_vertex[v])
      if ((corner >> 2) % 3 == 0) topology.tet_nodes[at(corner >> 2)][at(corner & 3)] = topology.num_nodes() - 1;
  }
  expect_rigorous("partly split", topology, mesh.vertices);
}

TEST(StableTimeStep, BoundsSliversAndNeedles) {
  for (const double height : {1.0, 0.3, 0.1, 0.01, 1e-3})
    for (const double lean : {0.0, 0.4, 2.0}) {
      const TetMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0.3, 1, 0}, {0.3 + lean, 0.4, height}}, {{0, 1, 2, 3}}};
      EXPECT_GE(bound_over_true(make_topology(mesh), mesh.vertices, 0.25).rigorous, 1.0 - 1e-12) << height << lean;
    }
}

TEST(StableTimeStep, PieceOfANodeFollowsFromItsCornersAlone) {
  const TetMesh mesh = grid_mesh(3, 1.0, 0.1);
  const Topology topology = make_topology(mesh);
  const Material material = make_material(1.0, 0.2, density, {0.3, 1.0});
  const auto stiffness = corner_stiffnesses(topology.tet_vertices, mesh.vertices, material);
  const auto masses = corner_masses(topology, tet_volumes(mesh.tets, mesh.vertices), density);
  const double dt = critical_time_step(topology, stiffness, lumped_masses(topology, masses));
  double smallest = 1e30;
  for (Index v = 0; v < topology.num_vertices(); ++v) {
    const auto corners = topology.corners_of_vertex[v];
    const double mass = corner_sum(corners, masses);
    smallest = std::min(smallest, 2.0 / std::sqrt(nodal_frequency_bound2(corners, stiffness, mass)));
    EXPECT_LE(smallest_mass(corners, stiffness, dt), mass * (1 + 1e-12));
    const double scaled = smallest_mass(corners, stiffness, 3 * dt);
    EXPECT_NEAR(2.0 / std::sqrt(nodal_frequency_bound2(corners, stiffness, scaled)), 3 * dt, 1e-12 * dt);
  }
  EXPECT_NEAR(smallest, dt, 1e-12 * dt);
  const auto elastic = corner_stiffnesses(topology.tet_vertices, mesh.vertices, make_material(1.0, 0.2, density));
  EXPECT_NEAR(stiffness[5] / elastic[5], 1.3, 1e-12);
}

}  // namespace
}  // namespace knap
