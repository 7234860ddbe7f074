#include "fem/elastic_force.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "core/errors.hpp"
#include "core/parallel.hpp"
#include "core/vector_targets.hpp"
#include "fem/tet_reference.hpp"
#include "tests/fem/elastic_body.hpp"
#include "tests/fem/plain_elastic.hpp"

namespace knap {
namespace {

// Gives a new node to the corners of every fifth vertex that lie in tets of odd number.
std::vector<Index> split_some(Topology& topology, std::vector<Vec4>& x, Index every) {
  std::vector<Index> changed;
  for (Index v = 0; v < topology.num_vertices(); v += every) {
    const Index copy = topology.num_nodes();
    bool used = false;
    for (const Index corner : topology.corners_of_vertex[v]) {
      if ((corner >> 2) % 2 == 0 || topology.node_of_corner(corner) != v) continue;
      topology.tet_nodes[at(corner >> 2)][at(corner & 3)] = copy;
      changed.push_back(corner >> 2);
      used = true;
    }
    if (!used) continue;
    topology.vertex_of_node.push_back(v);
    x.push_back(x[at(v)] + Vec4(1e-3, 2e-3, -1e-3, 0));
  }
  return changed;
}

TEST(ElasticForce, AgreesWithThePlainLoop) {
  ElasticBody body = elastic_body(7, elastic_material);  // 2058 tets: several blocks, the last one padded
  ASSERT_GT(body.elastic.blocks.blocks.size(), 3u);
  const auto x = moved(body.mesh, 0.03);
  const auto expected = plain_forces(body.topology, body.mesh.vertices, elastic_material, x);
  const auto f = body.forces(x);
  for (std::size_t i = 0; i < f.size(); ++i) EXPECT_LT((f[i] - expected[i]).norm(), 1e-12 / 7.0 / 7.0) << i;
  const double energy = plain_energy(body.topology, body.mesh.vertices, elastic_material, x);
  EXPECT_NEAR(strain_energy(body.elastic, x), energy, 1e-12 * energy);
}

TEST(ElasticForce, ForcesAreTheGradientOfTheEnergy) {
  ElasticBody body = elastic_body(2, elastic_material);
  auto x = moved(body.mesh, 0.05);
  const auto f = body.forces(x);
  const double h = 1e-6;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const double here = x[i][k];
      x[i][k] = here + h;
      const double up = strain_energy(body.elastic, x);
      x[i][k] = here - h;
      const double down = strain_energy(body.elastic, x);
      x[i][k] = here;
      EXPECT_NEAR(-(up - down) / (2 * h), f[i][k], 1e-9);  // rounding 1e-16/h, O(h^2)
    }
}

TEST(ElasticForce, PatchTest) {
  ElasticBody body = elastic_body(6, elastic_material);
  const Mat3 F = Mat3::Identity() + 0.05 * Mat3{{1.0, 0.3, -0.2}, {0.5, -0.7, 0.1}, {0.2, 0.4, 0.6}};
  std::vector<Vec4> x;
  for (const Vec3& v : body.mesh.vertices) x.push_back(padded(F * v));
  const Mat3 expected = cauchy_stress(std::get<NeoHookean>(elastic_material.law), F);
  update_stress(body.elastic, x);
  for (const TetStress& s : body.elastic.stress) {
    EXPECT_LT((as_matrix(s) - expected).norm(), 1e-12 * expected.norm() * 6.0);  // edges are 1/6: rounding of x over h
    EXPECT_NEAR(s.volume_ratio, F.determinant(), 1e-12);
    const Vec3 n = Vec3(1, 2, -2) / 3.0;
    EXPECT_LT((facet_traction(s, s, n) - expected * n).norm(), 1e-11 * expected.norm());
    EXPECT_LE(traction(s, n).norm(), expected.norm());
  }
  for (const double bound : body.elastic.stress_bound) {
    EXPECT_GE(bound, expected.norm());
    EXPECT_LE(bound, expected.norm() * (1 + 2e-6));
  }
  const auto f = body.forces(x);
  const double scale = expected.norm() / 36.0;  // stress times facet area
  for (std::size_t i = 0; i < f.size(); ++i) {
    const Vec3& v = body.mesh.vertices[i];
    if (v.minCoeff() > 0 && v.maxCoeff() < 1) {
      EXPECT_LT(f[i].norm(), 1e-10 * scale);
    }
  }
}

TEST(ElasticForce, RotationsAndTranslationsAreFree) {
  for (const Material& material : {elastic_material, viscous_material}) {
    ElasticBody body = elastic_body(5, material);
    const Mat3 R = Eigen::AngleAxisd(2.3, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    std::vector<Vec4> x;
    for (const Vec3& v : body.mesh.vertices) x.push_back(padded(R * v + Vec3(1, -2, 0.5)));
    for (const Vec4& force : body.forces(x, 0.1)) EXPECT_LT(force.norm(), 1e-14);
    update_stress(body.elastic, x);
    for (const float bound : body.elastic.stress_bound) EXPECT_LT(bound, 1e-13F);
    EXPECT_NEAR(strain_energy(body.elastic, x), 0.0, 1e-14);
  }
}

TEST(ElasticForce, MomentumAndAngularMomentumAreKept) {
  for (const Material& material : {elastic_material, viscous_material}) {
    ElasticBody body = elastic_body(5, material);
    const auto x = moved(body.mesh, 0.03);
    const auto f = body.forces(x, 0.1);
    Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
    for (std::size_t i = 0; i < x.size(); ++i) {
      force += xyz(f[i]);
      torque += xyz(x[i]).cross(xyz(f[i]));
    }
    EXPECT_LT(force.norm(), 1e-14);
    EXPECT_LT(torque.norm(), 1e-14);
  }
}

TEST(ElasticForce, CollapsedAndInvertedTetsStayFiniteAndPushBack) {
  const TetMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}};
  const Topology topology = make_topology(mesh);
  ElasticForce elastic = make_elastic_force(topology, mesh.vertices, elastic_material);
  for (const double height : {0.5, 0.1, 1e-9, 0.0, -0.3, -1.0}) {
    std::vector<Vec4> x, f(4);
    for (const Vec3& v : mesh.vertices) x.push_back(padded(v));
    x[3].z() = height;
    update_elastic_forces(elastic, x, f, 0.0);
    update_stress(elastic, x);
    EXPECT_GT(f[3].z(), 0.0) << height;
    EXPECT_TRUE(std::isfinite(elastic.stress_bound[0]));
    EXPECT_LT(as_matrix(elastic.stress[0])(2, 2), 0.0) << height;
    EXPECT_NEAR(elastic.stress[0].volume_ratio, height, 1e-15);
    EXPECT_NEAR(bulk_state(elastic, x).smallest_volume_ratio, height, 1e-15);
  }
}

TEST(ElasticForce, TetWithoutVolumeIsRefused) {
  TetMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2, 3}}};
  EXPECT_THROW(make_elastic_force(make_topology(mesh), mesh.vertices, elastic_material), InputError);
}

TEST(ElasticForce, UnusedVerticesGetNoForce) {
  ElasticBody body{grid_mesh(2, 1.0, 0.1), {}, {}};
  body.mesh.vertices.push_back({5, 5, 5});
  body.topology = make_topology(body.mesh);
  body.elastic = make_elastic_force(body.topology, body.mesh.vertices, elastic_material);
  EXPECT_EQ(body.forces(moved(body.mesh, 0.02)).back(), Vec4::Zero());
}

struct Sweeps {
  std::vector<Vec4> f;
  std::vector<TetStress> stress;
  std::vector<BranchGroup> branch;
  std::vector<double> numbers;
  bool operator==(const Sweeps& other) const {
    return same_bits(f, other.f) && same_bits(stress, other.stress) && same_bits(branch, other.branch) &&
           same_bits(numbers, other.numbers);
  }
};

Sweeps run_sweeps(ElasticBody body, const std::vector<Vec4>& x) {
  Sweeps s;
  s.f = body.forces(x, 0.3);
  s.f = body.forces(x, 0.3);
  update_stress(body.elastic, x);
  s.stress = body.elastic.stress;
  s.branch = body.elastic.branch.groups;
  s.numbers = {strain_energy(body.elastic, x), body.elastic.branch.stored, body.elastic.branch.dissipated};
  return s;
}

TEST(ElasticForce, SameBitsForAnyNumberOfThreads) {
  for (const Material& material : {elastic_material, viscous_material}) {
    const ElasticBody body = elastic_body(12, material);
    const auto x = moved(body.mesh, 0.02);
    set_num_threads(1);
    const Sweeps expected = run_sweeps(body, x);
    for (const int threads : {2, 3, 8}) {
      set_num_threads(threads);
      EXPECT_TRUE(run_sweeps(body, x) == expected) << threads;
    }
  }
}

TEST(ElasticForce, SameBitsOnAvx2AndAvx512) {
  const auto targets = vector_targets();
  if (std::find(targets.begin(), targets.end(), "AVX3") == targets.end()) GTEST_SKIP() << "no AVX-512 here";
  for (const Material& material : {elastic_material, viscous_material}) {
    const ElasticBody body = elastic_body(9, material);
    const auto x = moved(body.mesh, 0.02);
    use_vector_target("AVX3");
    const Sweeps wide = run_sweeps(body, x);
    use_vector_target("AVX2");
    const Sweeps narrow = run_sweeps(body, x);
    use_vector_target("");
    EXPECT_TRUE(wide == narrow);
  }
}

TEST(ElasticForce, EveryInstructionSetAgreesWithThePlainLoop) {
  for (const std::string& target : vector_targets()) {
    use_vector_target(target);
    ElasticBody body = elastic_body(5, elastic_material);
    const auto x = moved(body.mesh, 0.03);
    const auto expected = plain_forces(body.topology, body.mesh.vertices, elastic_material, x);
    const auto f = body.forces(x);
    for (std::size_t i = 0; i < f.size(); ++i) EXPECT_LT((f[i] - expected[i]).norm(), 1e-12 / 25.0) << target << i;
    update_stress(body.elastic, x);
    for (Index t = 0; t < body.topology.num_tets(); ++t) {
      const Mat3 s = plain_stress(body.mesh.vertices, body.topology, elastic_material, x, t);
      EXPECT_LT((as_matrix(body.elastic.stress[at(t)]) - s).norm(), 1e-12) << target << t;
    }
  }
  use_vector_target("");
}

TEST(ElasticForce, RefreshAfterSplitsEqualsBuildingFromScratch) {
  ElasticBody body = elastic_body(9, elastic_material);
  auto x = moved(body.mesh, 0.02);
  for (const Index every : {97, 31, 5, 2, 1}) {
    const auto changed = split_some(body.topology, x, every);
    refresh_elastic_force(body.elastic, body.topology, changed);
    ElasticBody fresh = body;
    fresh.elastic = make_elastic_force(body.topology, body.mesh.vertices, elastic_material);
    EXPECT_TRUE(same_bits(body.forces(x), fresh.forces(x))) << every;
    EXPECT_EQ(strain_energy(body.elastic, x), strain_energy(fresh.elastic, x));
    const auto expected = plain_forces(body.topology, body.mesh.vertices, elastic_material, x);
    const auto f = body.forces(x);
    for (std::size_t i = 0; i < f.size(); ++i) ASSERT_LT((f[i] - expected[i]).norm(), 1e-12 / 25.0);
  }
}

TEST(ElasticForce, SeparateTetsFillTheLargestBlock) {
  TetMesh mesh = grid_mesh(2, 1.0, 0.1);
  Topology topology = make_topology(mesh);
  std::vector<Vec4> x;
  topology.vertex_of_node.clear();
  std::vector<Index> all(topology.tet_nodes.size());
  std::iota(all.begin(), all.end(), 0);
  for (auto& tet : topology.tet_nodes)
    for (Index& node : tet) {
      x.push_back(padded(1.01 * mesh.vertices[at(node)]));
      topology.vertex_of_node.push_back(node);
      node = topology.num_nodes() - 1;
    }
  ElasticForce elastic = make_elastic_force(topology, mesh.vertices, elastic_material);
  EXPECT_EQ(elastic.blocks.num_slots, 0);
  std::vector<Vec4> f(x.size());
  update_elastic_forces(elastic, x, f, 0.0);
  const auto expected = plain_forces(topology, mesh.vertices, elastic_material, x);
  for (std::size_t i = 0; i < f.size(); ++i) ASSERT_LT((f[i] - expected[i]).norm(), 1e-13);
}

TEST(ElasticForce, BranchAgreesWithThePointLaw) {
  ElasticBody body = elastic_body(4, viscous_material);
  std::vector<ViscoelasticHistory> history(at(body.topology.num_tets()));
  double dissipated = 0.0, pending = 0.0;
  for (unsigned n = 0; n < 5; ++n) {
    const auto x = moved(body.mesh, 0.02, n);
    const PlainBranchForces expected =
        plain_branch_forces(body.topology, body.mesh.vertices, viscous_material, x, 0.3, history);
    const auto f = body.forces(x, 0.3);
    for (std::size_t i = 0; i < f.size(); ++i) ASSERT_LT((f[i] - expected.f[i]).norm(), 1e-12 / 16.0) << n;
    dissipated += pending + expected.dissipated_before;
    pending = expected.dissipated_after;
    EXPECT_NEAR(body.elastic.branch.stored, expected.stored, 1e-12 * expected.stored);
    EXPECT_NEAR(body.elastic.branch.dissipated, dissipated, 1e-12 * dissipated);
    const double bulk = plain_energy(body.topology, body.mesh.vertices, viscous_material, x);
    EXPECT_NEAR(strain_energy(body.elastic, x), bulk + expected.stored, 1e-12 * bulk);
    update_stress(body.elastic, x);
    for (Index t = 0; t < body.topology.num_tets(); ++t)
      EXPECT_LT((as_matrix(body.elastic.stress[at(t)]) - expected.stress[at(t)]).norm(), 1e-12);
  }
}

TEST(ElasticForce, HeldBodyRelaxesToTheLongTermForces) {
  ElasticBody viscous = elastic_body(3, viscous_material), elastic = elastic_body(3, elastic_material);
  const auto x = moved(viscous.mesh, 0.03);
  const auto long_term = elastic.forces(x), start = viscous.forces(x, 0.0);
  const double dt = 0.05;
  for (int n = 0; n < 100; ++n) {
    const auto f = viscous.forces(x, dt);
    const double left = std::exp(-(n + 0.5) * dt / 2.0);
    for (std::size_t i = 0; i < f.size(); ++i)
      EXPECT_LT((f[i] - long_term[i] - left * (start[i] - long_term[i])).norm(), 1e-14);
  }
}

// A ringing cube under leapfrog: kinetic + stored + dissipated stays what it was.
TEST(ElasticForce, LeapfrogWithBranchClosesTheEnergyBalance) {
  ElasticBody body = elastic_body(3, viscous_material);
  const double dt = 0.01, mass = 1.0 / static_cast<double>(body.mesh.vertices.size());
  std::vector<Vec4> x;
  for (const Vec3& v : body.mesh.vertices) x.push_back(padded(Vec3(1.05, 1.0, 0.97).cwiseProduct(v)));
  std::vector<Vec4> v(x.size(), Vec4::Zero()), f(x.size());
  update_elastic_forces(body.elastic, x, f, 0.0);
  const double initial = strain_energy(body.elastic, x);
  double loss = 0.0, worst = 0.0;
  for (int n = 0; n < 2000; ++n) {
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += dt * (v[i] += 0.5 * dt / mass * f[i]);
    update_elastic_forces(body.elastic, x, f, dt);
    double kinetic = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) kinetic += 0.5 * mass * (v[i] += 0.5 * dt / mass * f[i]).squaredNorm();
    EXPECT_GE(body.elastic.branch.dissipated, loss);
    loss = body.elastic.branch.dissipated;
    worst = std::max(worst, std::abs(kinetic + strain_energy(body.elastic, x) + loss - initial));
  }
  EXPECT_GT(loss, 0.2 * initial);
  EXPECT_LT(worst, 2e-3 * initial);  // (omega dt)^2 of the highest mode that rings
}

}  // namespace
}  // namespace knap
