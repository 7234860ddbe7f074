#include "fem/sleeping_tets.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "core/parallel.hpp"
#include "tests/fem/elastic_body.hpp"
#include "tests/fem/plain_elastic.hpp"

namespace knap {
namespace {

std::vector<Index> all_tets(const Topology& topology) {
  std::vector<Index> all(topology.tet_nodes.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

// About this share of the tets, or none or all.
std::vector<Index> some_tets(const Topology& topology, double share, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> dice(0.0, 1.0);
  std::vector<Index> some;
  for (Index t = 0; t < topology.num_tets(); ++t)
    if (dice(random) < share) some.push_back(t);
  return some;
}

// Tets of a topology as one of their own, for the plain loops.
Topology part(const Topology& topology, std::span<const Index> tets) {
  Topology part;
  for (const Index t : tets) {
    part.tet_nodes.push_back(topology.tet_nodes[at(t)]);
    part.tet_vertices.push_back(topology.tet_vertices[at(t)]);
  }
  return part;
}

void expect_near(const std::vector<Vec4>& f, const std::vector<Vec4>& expected) {
  for (std::size_t i = 0; i < f.size(); ++i) ASSERT_LT((f[i] - expected[i]).norm(), 1e-12 / 25.0) << i;
}

TEST(SleepingTets, HaveNoForceEnergyOrStress) {
  ElasticBody body = elastic_body(7, elastic_material);
  const auto x = moved(body.mesh, 0.02);
  for (const double share : {0.5, 0.05, 0.0, 0.9, 1.0}) {
    const auto active = some_tets(body.topology, share, 3);
    body.activate(active);
    const Topology awake = part(body.topology, active);
    expect_near(body.forces(x), plain_forces(awake, body.mesh.vertices, elastic_material, x));
    const double energy = plain_energy(awake, body.mesh.vertices, elastic_material, x);
    EXPECT_NEAR(strain_energy(body.elastic, x), energy, 1e-12 * energy);
    update_stress(body.elastic, x);
    for (const Index t : active) {
      const Mat3 s = plain_stress(body.mesh.vertices, body.topology, elastic_material, x, t);
      ASSERT_LT((as_matrix(body.elastic.stress[at(t)]) - s).norm(), 1e-12);
      ASSERT_GE(body.elastic.stress_bound[at(t)], s.norm());
    }
    const auto asleep = sleeping_tets(body.elastic);
    EXPECT_EQ(asleep.size() + active.size(), body.topology.tet_nodes.size());
    for (const Index t : asleep) {
      ASSERT_EQ(as_matrix(body.elastic.stress[at(t)]), Mat3::Zero());
      ASSERT_LT(body.elastic.stress_bound[at(t)], -1e30F);
    }
  }
}

TEST(SleepingTets, OnlyWhichSleepCountsNotHowThatCameAbout) {
  for (const Material& material : {elastic_material, viscous_material}) {
    ElasticBody direct = elastic_body(9, material), stepwise = direct;
    const auto x = moved(direct.mesh, 0.02);
    const auto active = some_tets(direct.topology, 0.4, 5);
    direct.activate(active);
    for (const unsigned seed : {1u, 2u, 3u}) stepwise.activate(some_tets(direct.topology, 0.3 * seed, seed));
    stepwise.activate(active);
    EXPECT_TRUE(same_bits(direct.forces(x, 0.3), stepwise.forces(x, 0.3)));
    EXPECT_EQ(strain_energy(direct.elastic, x), strain_energy(stepwise.elastic, x));
  }
}

TEST(SleepingTets, WokenGiveTheBitsOfThoseThatNeverSlept) {
  for (const Material& material : {elastic_material, viscous_material})
    for (const int threads : {1, 3}) {
      set_num_threads(threads);
      ElasticBody slept = elastic_body(9, material), never = slept;
      const auto x = moved(slept.mesh, 0.02), later = moved(slept.mesh, 0.02, 8);
      EXPECT_TRUE(same_bits(slept.forces(x, 0.3), never.forces(x, 0.3)));
      slept.activate(some_tets(slept.topology, 0.2, 4));
      slept.activate(all_tets(slept.topology));
      EXPECT_TRUE(same_bits(slept.forces(later, 0.3), never.forces(later, 0.3)));
      EXPECT_EQ(strain_energy(slept.elastic, later), strain_energy(never.elastic, later));
      EXPECT_EQ(slept.elastic.branch.dissipated, never.elastic.branch.dissipated);
    }
  set_num_threads(0);
}

// Splits while some tets sleep, also of tets that do: forces, and the blocks, as if made from scratch.
TEST(SleepingTets, FollowSplits) {
  ElasticBody body = elastic_body(9, elastic_material);
  auto x = moved(body.mesh, 0.02);
  const auto active = some_tets(body.topology, 0.5, 6);
  body.activate(active);
  std::vector<Index> changed;
  for (Index t = 5; t < body.topology.num_tets(); t += 7) {
    const Index node = body.topology.tet_nodes[at(t)][2];
    body.topology.tet_nodes[at(t)][2] = body.topology.num_nodes();
    body.topology.vertex_of_node.push_back(body.topology.vertex_of_node[at(node)]);
    x.push_back(x[at(node)] + Vec4(1e-3, -2e-3, 1e-3, 0.0));
    changed.push_back(t);
  }
  refresh_elastic_force(body.elastic, body.topology, changed);
  for (const auto& now : {active, some_tets(body.topology, 0.7, 7)}) {
    body.activate(now);
    expect_near(body.forces(x), plain_forces(part(body.topology, now), body.mesh.vertices, elastic_material, x));
    ElasticBody fresh = body;
    fresh.elastic = make_elastic_force(body.topology, body.mesh.vertices, elastic_material);
    fresh.activate(now);
    EXPECT_TRUE(same_bits(body.forces(x), fresh.forces(x)));
  }
}

/// The branch by the point law; sleeping tets keep their history.
struct PlainBranch {
  std::vector<ViscoelasticHistory> history;

  PlainBranchForces forces(const ElasticBody& body, std::span<const Index> active, std::span<const Vec4> x, double dt) {
    std::vector<ViscoelasticHistory> own;
    for (const Index t : active) own.push_back(history[at(t)]);
    auto result = plain_branch_forces(part(body.topology, active), body.mesh.vertices, viscous_material, x, dt, own);
    for (std::size_t i = 0; i < active.size(); ++i) history[at(active[i])] = own[i];
    return result;
  }
};

TEST(SleepingTets, RememberWhatTheirBranchHasRelaxedTo) {
  ElasticBody body = elastic_body(5, viscous_material);
  PlainBranch plain{std::vector<ViscoelasticHistory>(body.topology.tet_nodes.size())};
  for (unsigned n = 0; n < 8; ++n) {
    const auto active = some_tets(body.topology, n % 4 == 0 ? 1.0 : 0.4, n);
    body.activate(active);
    const auto x = moved(body.mesh, 0.02, 20 + n);
    const PlainBranchForces expected = plain.forces(body, active, x, 0.3);
    expect_near(body.forces(x, 0.3), expected.f);
    EXPECT_NEAR(body.elastic.branch.stored, expected.stored, 1e-12 * expected.stored);
  }
}

TEST(SleepingTets, MetricsGoOverToAnotherBody) {
  ElasticBody body = elastic_body(5, viscous_material), restored = body;
  body.forces(moved(body.mesh, 0.02, 1), 0.3);
  const auto active = some_tets(body.topology, 0.4, 2);
  body.activate(active);
  body.forces(moved(body.mesh, 0.02, 2), 0.3);
  restored.activate(active);
  set_relaxed_metrics(restored.elastic, relaxed_metrics(body.elastic));
  EXPECT_TRUE(same_bits(relaxed_metrics(restored.elastic), relaxed_metrics(body.elastic)));
  for (ElasticBody* b : {&body, &restored}) b->activate(all_tets(body.topology));
  EXPECT_TRUE(same_bits(body.forces(moved(body.mesh, 0.02, 3), 0.3), restored.forces(moved(body.mesh, 0.02, 3), 0.3)));
}

// Materials in runs, as of several particles, and mixed, as of grains.
TEST(SeveralMaterials, EachTetHasItsOwn) {
  const std::vector<Material> materials{elastic_material, make_material(5.0, 0.1, 1.0), make_material(0.3, 0.4, 1.0)};
  const Topology topology = make_topology(grid_mesh(7, 1.0, 0.15));
  std::vector<Index> in_runs, mixed;
  for (Index t = 0; t < topology.num_tets(); ++t) {
    in_runs.push_back(3 * t / topology.num_tets());
    mixed.push_back((t / 5) % 3);
  }
  for (const auto& material_of_tet : {in_runs, mixed}) {
    ElasticBody body = elastic_body(7, materials, material_of_tet);
    const auto x = moved(body.mesh, 0.02);
    for (const double share : {1.0, 0.4}) {
      const auto active = some_tets(topology, share, 1);
      body.activate(active);
      std::vector<Vec4> expected(x.size(), Vec4::Zero());
      double energy = 0.0;
      for (Index m = 0; m < 3; ++m) {
        std::vector<Index> own;
        for (const Index t : active)
          if (material_of_tet[at(t)] == m) own.push_back(t);
        const auto f = plain_forces(part(topology, own), body.mesh.vertices, materials[at(m)], x);
        for (std::size_t i = 0; i < f.size(); ++i) expected[i] += f[i];
        energy += plain_energy(part(topology, own), body.mesh.vertices, materials[at(m)], x);
      }
      expect_near(body.forces(x), expected);
      EXPECT_NEAR(strain_energy(body.elastic, x), energy, 1e-12 * energy);
    }
    update_stress(body.elastic, x);
    const Index t = topology.num_tets() / 2;
    const auto s = plain_stress(body.mesh.vertices, topology, materials[at(material_of_tet[at(t)])], x, t);
    body.activate(all_tets(topology));
    update_stress(body.elastic, x);
    EXPECT_LT((as_matrix(body.elastic.stress[at(t)]) - s).norm(), 1e-12);
  }
}

TEST(SeveralMaterials, OneMayHaveABranchAndAnotherNone) {
  const std::vector<Material> materials{elastic_material, viscous_material};
  const Topology topology = make_topology(grid_mesh(6, 1.0, 0.15));
  std::vector<Index> material_of_tet, elastic_tets, viscous_tets;
  for (Index t = 0; t < topology.num_tets(); ++t) {
    material_of_tet.push_back((t / 100) % 2);
    (material_of_tet.back() ? viscous_tets : elastic_tets).push_back(t);
  }
  ElasticBody body = elastic_body(6, materials, material_of_tet);
  PlainBranch plain{std::vector<ViscoelasticHistory>(topology.tet_nodes.size())};
  double dissipated = 0.0, pending = 0.0;
  for (const unsigned n : {1u, 2u, 3u}) {
    const auto x = moved(body.mesh, 0.02, n);
    const PlainBranchForces viscous = plain.forces(body, viscous_tets, x, 0.3);
    auto expected = plain_forces(part(topology, elastic_tets), body.mesh.vertices, elastic_material, x);
    for (std::size_t i = 0; i < expected.size(); ++i) expected[i] += viscous.f[i];
    expect_near(body.forces(x, 0.3), expected);
    dissipated += pending + viscous.dissipated_before;
    pending = viscous.dissipated_after;
    EXPECT_NEAR(body.elastic.branch.stored, viscous.stored, 1e-12 * viscous.stored);
    EXPECT_NEAR(body.elastic.branch.dissipated, dissipated, 1e-12 * dissipated);
  }
}

}  // namespace
}  // namespace knap
