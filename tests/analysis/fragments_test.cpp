#include "analysis/fragments.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "box_mesh.hpp"

namespace knap {
namespace {

constexpr double round_off = 1e-12;

void expect_near(const Vec3& value, const Vec3& expected, double tolerance) {
  EXPECT_LT((value - expected).norm(), tolerance) << value.transpose() << " instead of " << expected.transpose();
}

Mat3 some_rotation() { return Eigen::AngleAxisd(0.7, Vec3(1.0, -2.0, 0.5).normalized()).toRotationMatrix(); }

void rotate(MovingMesh& mesh, const Mat3& rotation) {
  for (Vec4& p : mesh.x) p = padded(rotation * Vec3(xyz(p)));
}

void spin(MovingMesh& mesh, const Vec3& centre, const Vec3& velocity, const Vec3& spin) {
  for (std::size_t i = 0; i < mesh.x.size(); ++i)
    mesh.v[i] = padded(velocity + spin.cross(Vec3(xyz(mesh.x[i])) - centre));
}

Fragment only_fragment(MovingMesh mesh, double density = 1.0) {
  const auto fragments = find_fragments(mesh.input(density));
  EXPECT_EQ(fragments.size(), 1u);
  return fragments.at(0);
}

TEST(FragmentShape, CubeHasTheKnownSphericityAndEqualSizes) {
  const Fragment cube = only_fragment(MovingMesh(box_mesh({2e-3, 2e-3, 2e-3}, {4, 4, 4})));
  EXPECT_NEAR(cube.sphericity, 0.806, 5e-4);  // Wadell 1932
  EXPECT_NEAR(cube.sphericity, std::cbrt(std::numbers::pi / 6.0), round_off);
  EXPECT_NEAR(cube.surface, 24e-6, 24e-6 * round_off);
  expect_near(cube.sizes, {2e-3, 2e-3, 2e-3}, 1e-9);
  EXPECT_NEAR(cube.sieve_size, 2e-3, 1e-9);
  EXPECT_NEAR(cube.elongation, 1.0, 1e-6);
  EXPECT_NEAR(cube.flatness, 1.0, 1e-6);
  EXPECT_NEAR(cube.convexity, 1.0, round_off);
}

TEST(FragmentShape, SizesOfAnElongatedBoxDoNotDependOnItsOrientation) {
  MovingMesh mesh(box_mesh({2.0, 3.0, 9.0}, {2, 3, 9}));
  rotate(mesh, some_rotation());
  const Fragment box = only_fragment(mesh);
  expect_near(box.sizes, {9.0, 3.0, 2.0}, 1e-5);  // the tilt of the principal axes
  EXPECT_NEAR(box.elongation, 3.0 / 9.0, 1e-6);
  EXPECT_NEAR(box.flatness, 2.0 / 3.0, 1e-6);
  EXPECT_NEAR(box.sieve_size, 3.0, 1e-5);
  EXPECT_NEAR(box.convexity, 1.0, 1e-12);
  EXPECT_NEAR(box.sphericity, std::cbrt(std::numbers::pi) * std::pow(6.0 * 54.0, 2.0 / 3.0) / 102.0, round_off);
}

TEST(FragmentShape, SlabPassesASquareHoleOnItsDiagonal) {
  const Fragment slab = only_fragment(MovingMesh(box_mesh({10.0, 4.0, 0.5}, {10, 4, 1})));
  EXPECT_NEAR(slab.sieve_size, (4.0 + 0.5) / std::numbers::sqrt2, 1e-5);
  EXPECT_NEAR(slab.flatness, 0.125, 1e-6);
}

TEST(FragmentShape, SphereIsRound) {
  MovingMesh mesh(box_mesh({2.0, 2.0, 2.0}, {16, 16, 16}));
  for (Vec4& p : mesh.x) {  // each cube shell becomes a sphere
    const Vec3 q = Vec3(xyz(p)) - Vec3::Ones();
    if (q.norm() > 0.0) p = padded(q * (q.lpNorm<Eigen::Infinity>() / q.norm()));
  }
  const Fragment sphere = only_fragment(mesh);
  EXPECT_NEAR(sphere.sphericity, 1.0, 0.02);  // of the inscribed polyhedron
  EXPECT_NEAR(sphere.convexity, 1.0, 0.01);
  EXPECT_NEAR(sphere.sieve_size, 2.0, 0.02);
  expect_near(sphere.sizes, {2.0, 2.0, 2.0}, 0.02);
}

TEST(FragmentShape, ConvexityOfAnLIsItsShareOfTheHull) {
  MovingMesh mesh(box_mesh({2.0, 2.0, 1.0}, {2, 2, 1}));
  for (Index tet = 0; tet < mesh.topology.num_tets(); ++tet) {
    const Vec3 c = mesh.tet_centre(tet);
    mesh.label[at(tet)] = c.x() > 1.0 && c.y() > 1.0 ? 7 : 3;
  }
  const auto fragments = find_fragments(mesh.input());
  ASSERT_EQ(fragments.size(), 2u);
  EXPECT_NEAR(fragments[0].convexity, 3.0 / 3.5, 1e-12);
  EXPECT_NEAR(fragments[0].surface, 14.0, 1e-12);
  EXPECT_NEAR(fragments[1].convexity, 1.0, 1e-12);
}

TEST(FragmentShape, CracksInsideAFragmentAreNotSurface) {
  MovingMesh mesh(box_mesh({1.0, 1.0, 1.0}, {2, 2, 2}));
  const Index tet = mesh.topology.facet_tets[0][0];  // give one tet corners of its own, label unchanged
  for (Index& node : mesh.topology.tet_nodes[at(tet)]) {
    mesh.x.push_back(mesh.x[at(node)]);
    mesh.v.push_back(mesh.v[at(node)]);
    node = to_index(mesh.x.size()) - 1;
  }
  EXPECT_NEAR(only_fragment(mesh).surface, 6.0, round_off);
}

TEST(FragmentShape, FlatAndCollapsedPiecesStayFinite) {
  for (const Vec3& scale : {Vec3(1.0, 1.0, 0.0), Vec3(1.0, 0.0, 0.0), Vec3(0.0, 0.0, 0.0), Vec3(1.0, 1.0, 1e-14)}) {
    for (const Index n : {1, 2}) {
      MovingMesh mesh(box_mesh({1.0, 1.0, 1.0}, {n, n, n}));
      for (Vec4& p : mesh.x) p = padded(some_rotation() * scale.cwiseProduct(Vec3(xyz(p))));
      spin(mesh, Vec3::Zero(), {1.0, 2.0, 3.0}, {4.0, 5.0, 6.0});
      const Fragment piece = only_fragment(mesh);
      EXPECT_TRUE(piece.sizes.allFinite() && piece.spin.allFinite() && piece.velocity.allFinite());
      EXPECT_TRUE(std::isfinite(piece.sieve_size) && std::isfinite(piece.sphericity));
      EXPECT_GE(piece.convexity, 0.0);
      EXPECT_LE(piece.convexity, 1.0);
      EXPECT_NEAR(piece.mass, 1.0, round_off);
    }
  }
}

TEST(FragmentMotion, IntactSpinningBoxHasItsVelocitySpinAndMass) {
  MovingMesh mesh(box_mesh({2e-3, 3e-3, 5e-3}, {3, 2, 4}));
  rotate(mesh, some_rotation());
  const Vec3 centre = some_rotation() * Vec3(1e-3, 1.5e-3, 2.5e-3);
  spin(mesh, centre, {3.0, -16.0, 0.5}, {200.0, -300.0, 1e4});
  const Fragment box = only_fragment(mesh, 1270.0);
  EXPECT_EQ(box.id, 0);
  EXPECT_EQ(box.num_tets, 6 * 24);
  EXPECT_TRUE(box.resolved());
  EXPECT_NEAR(box.volume, 30e-9, 30e-9 * round_off);
  EXPECT_NEAR(box.mass, 1270.0 * 30e-9, 1e-16);
  expect_near(box.centre, centre, 1e-15);
  expect_near(box.velocity, {3.0, -16.0, 0.5}, 1e-10);
  expect_near(box.spin, {200.0, -300.0, 1e4}, 1e-6);
}

TEST(FragmentMotion, RigidSpinOfASingleTetIsRecovered) {
  TetMesh one{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}};
  MovingMesh mesh(one);
  spin(mesh, {0.25, 0.25, 0.25}, {1.0, 0.0, 0.0}, {0.0, 2.0, -1.0});
  const Fragment tet = only_fragment(mesh);
  EXPECT_FALSE(tet.resolved());
  expect_near(tet.centre, {0.25, 0.25, 0.25}, round_off);
  expect_near(tet.velocity, {1.0, 0.0, 0.0}, round_off);
  expect_near(tet.spin, {0.0, 2.0, -1.0}, round_off);
  EXPECT_NEAR(tet.convexity, 1.0, round_off);
}

TEST(FragmentMotion, ALineHasNoSpinAboutItself) {
  MovingMesh mesh(box_mesh({1.0, 1.0, 1.0}, {1, 1, 1}));
  for (Vec4& p : mesh.x) p = padded({p.x(), 0.0, 0.0});
  spin(mesh, {0.5, 0.0, 0.0}, Vec3::Zero(), {9.0, 2.0, 0.0});
  expect_near(only_fragment(mesh).spin, {0.0, 2.0, 0.0}, 1e-10);
}

TEST(Fragments, TwoHalvesAreApartAlthoughTheyShareNodes) {
  MovingMesh mesh(box_mesh({3.0, 1.0, 1.0}, {3, 1, 1}));
  for (Index tet = 0; tet < mesh.topology.num_tets(); ++tet)
    mesh.label[at(tet)] = mesh.tet_centre(tet).x() < 1.0 ? 0 : 1;
  const auto fragments = find_fragments(mesh.input(2.0));
  ASSERT_EQ(fragments.size(), 2u);
  EXPECT_EQ(fragments[0].num_tets, 12);
  EXPECT_NEAR(fragments[0].mass, 4.0, round_off);
  EXPECT_NEAR(fragments[1].mass, 2.0, round_off);
  expect_near(fragments[0].centre, {2.0, 0.5, 0.5}, round_off);
  expect_near(fragments[1].centre, {0.5, 0.5, 0.5}, round_off);
  EXPECT_NEAR(fragments[0].surface, 10.0, round_off);
  EXPECT_NEAR(fragments[1].surface, 6.0, round_off);
}

TEST(Fragments, MomentumAndAngularMomentumAddUpToTheWhole) {
  MovingMesh mesh(box_mesh({1.0, 1.0, 1.0}, {4, 4, 4}));
  for (std::size_t i = 0; i < mesh.v.size(); ++i) {
    const double s = static_cast<double>(i);
    mesh.v[i] = padded({std::sin(s), std::cos(2.0 * s), std::sin(3.0 * s)});
  }
  const Fragment whole = only_fragment(mesh);
  for (Index tet = 0; tet < mesh.topology.num_tets(); ++tet) mesh.label[at(tet)] = tet % 5;
  Vec3 momentum = Vec3::Zero();
  double mass = 0.0;
  for (const Fragment& fragment : find_fragments(mesh.input())) {
    momentum += fragment.mass * fragment.velocity;
    mass += fragment.mass;
  }
  EXPECT_NEAR(mass, whole.mass, round_off);
  expect_near(momentum, whole.mass * whole.velocity, round_off);
}

TEST(Fragments, LabelsAreRenamedByDescendingVolumeTiesByLowestTet) {
  const std::vector<Index> label{4, 1, 1, 9, 4, 9, 6};
  const std::vector<double> volume{1.0, 1.0, 1.0, 2.0, 1.0, 3.0, 1.0};
  EXPECT_THAT(labels_by_size(label, volume), testing::ElementsAre(1, 2, 2, 0, 1, 0, 3));
  EXPECT_TRUE(labels_by_size({}, {}).empty());
}

TEST(Fragments, OrderDoesNotDependOnTheNamesOfTheLabels) {
  MovingMesh mesh(box_mesh({1.0, 1.0, 1.0}, {3, 3, 3}));
  const auto ids = [&](Index factor) {
    for (Index tet = 0; tet < mesh.topology.num_tets(); ++tet) mesh.label[at(tet)] = (tet / 7 * factor) % 101;
    return labels_by_size(mesh.label, mesh.tet_volumes);
  };
  EXPECT_EQ(ids(1), ids(17));
}

}  // namespace
}  // namespace knap
