#include "quasistatic/equilibrium.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/errors.hpp"
#include "core/parallel.hpp"
#include "tests/quasistatic/press.hpp"
#include "tests/support/bar_mesh.hpp"

namespace knap {
namespace {

Vec3 sum_of_friction(const LoadState& state) {
  Vec3 sum = Vec3::Zero();
  for (const PlatenContact& contact : state.contacts) sum += contact.friction;
  return sum;
}

// Frictionless: uniaxial stress, P = mu F + U'(J) cof F with no stress on the sides.
TEST(Equilibrium, ABlockIsCompressedUniformly) {
  const PressedBody block{bar_mesh({4, 3, 5}, 1e-4)};
  const Lame l = block.material.small_strain();
  EquilibriumSolver solver(block.view(), block.platens());
  LoadState state = solver.start();
  const double height = 5e-4, area = 4e-4 * 3e-4;
  for (const double strain : {0.001, 0.01, 0.05}) {
    ASSERT_TRUE(solver.solve(state, strain * height));
    const double axial = 1.0 - strain;
    double side = 1.0;  // P_xx = mu side + U'(J) side axial = 0
    for (int i = 0; i < 60; ++i) side = std::sqrt((1.0 + l.mu / (l.lambda + l.mu) * (1.0 - 1.0 / axial)) / axial);
    const double slope = (l.lambda + l.mu) * (side * side * axial - 1.0) - l.mu;
    const double pressure = -(l.mu * axial + slope * side * side);
    EXPECT_NEAR(solver.force(state), pressure * area, 1e-6 * pressure * area) << strain;
    EXPECT_LT(solver.out_of_line(state), 1e-6 * height);
    EXPECT_EQ(sum_of_friction(state), Vec3::Zero());
  }
}

TEST(Equilibrium, ForceIsTheDerivativeOfTheEnergy) {
  const PressedBody sphere{coarse_sphere()};
  EquilibriumSolver solver(sphere.view(), sphere.platens());
  LoadState state = solver.start();
  const double approach = 60e-6, h = 0.1e-6;
  ASSERT_TRUE(solver.solve(state, approach - h));
  const double before = solver.strain_energy(state);
  ASSERT_TRUE(solver.solve(state, approach + h));
  const double after = solver.strain_energy(state);
  ASSERT_TRUE(solver.solve(state, approach));
  EXPECT_NEAR((after - before) / (2.0 * h), solver.force(state), 1e-3 * solver.force(state));
}

// With the rate of change found at one equilibrium the next one is predicted, force and all.
TEST(Equilibrium, RateLeadsToTheNextEquilibrium) {
  for (const double friction : {0.0, 0.5}) {
    const PressedBody sphere{.mesh = coarse_sphere(), .friction = friction};
    EquilibriumSolver solver(sphere.view(), sphere.platens());
    LoadState state = solver.start();
    const double approach = 60e-6, h = 0.2e-6;
    ASSERT_TRUE(solver.solve(state, approach));
    const auto rate = solver.rate(state);
    const auto x = state.x;
    ASSERT_TRUE(solver.solve(state, approach + h));
    double error = 0.0, change = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      error += (state.x[i] - x[i] - h * rate[i]).squaredNorm();
      change += (state.x[i] - x[i]).squaredNorm();
    }
    EXPECT_LT(std::sqrt(error / change), 0.02) << friction;
  }
}

TEST(Equilibrium, FrictionStaysInTheConeAndAddsNoForceToTheWhole) {
  for (const double friction : {0.05, 0.4}) {
    const PressedBody sphere{.mesh = coarse_sphere(), .friction = friction};
    EquilibriumSolver solver(sphere.view(), sphere.platens());
    LoadState state = solver.start();
    int sliding = 0, closed = 0;
    for (const double approach : {40e-6, 60e-6, 80e-6}) ASSERT_TRUE(solver.solve(state, approach));
    for (const PlatenContact& contact : state.contacts) {
      if (!contact.is_closed) continue;
      ++closed;
      sliding += contact.slides ? 1 : 0;
      EXPECT_GE(contact.push, -1e-5 * solver.force(state));
      EXPECT_LE(contact.friction.norm(), friction * contact.push * (1.0 + 1e-9) + 1e-6 * solver.force(state));
    }
    EXPECT_GT(closed, 6);
    EXPECT_GT(sliding, 0) << friction;
    EXPECT_LT(sum_of_friction(state).norm(), 1e-5 * solver.force(state));
  }
}

// A frictionless sphere is free to float sideways, to spin and to roll. It rolls onto the nearest nodes, no further.
TEST(Equilibrium, AFloatingBodyStaysWhereItIs) {
  const PressedBody sphere{coarse_sphere()};
  EquilibriumSolver solver(sphere.view(), sphere.platens());
  LoadState state = solver.start();
  const LoadState start = state;
  ASSERT_TRUE(solver.solve(state, 80e-6));
  Vec3 shift = Vec3::Zero(), turn = Vec3::Zero();
  for (std::size_t i = 0; i < state.x.size(); ++i) {
    const Vec3 u = xyz(state.x[i]) - xyz(start.x[i]);
    shift += u;
    turn += Vec3(xyz(start.x[i])).cross(u) / (0.75e-3 * 0.75e-3);
  }
  const auto nodes = static_cast<double>(state.x.size());
  EXPECT_LT(shift.head<2>().norm() / nodes, 0.5e-6);  // of an approach of 80 um
  EXPECT_LT(std::abs(turn.z()) / nodes, 1e-4);        // [rad]
  EXPECT_LT(turn.norm() / nodes, 0.1 * 0.2 / 0.75);   // a tenth of an element
}

TEST(Equilibrium, SameBitsForAnyNumberOfThreads) {
  const PressedBody sphere{.mesh = coarse_sphere(), .friction = 0.3};
  std::vector<std::vector<Vec4>> found;
  for (const int threads : {1, 4}) {
    set_num_threads(threads);
    EquilibriumSolver solver(sphere.view(), sphere.platens());
    LoadState state = solver.start();
    ASSERT_TRUE(solver.solve(state, 50e-6));
    found.push_back(state.x);
  }
  EXPECT_EQ(found[0], found[1]);
}

TEST(Equilibrium, ABodyThatDoesNotFitIsRefused) {
  const PressedBody sphere{coarse_sphere()};
  auto platens = sphere.platens();
  platens[1].point.z() -= 1e-5;
  EXPECT_THROW(EquilibriumSolver(sphere.view(), platens), InputError);
  platens = sphere.platens();
  platens[1].point.x() += 1.0;
  platens[1].radius = 1e-3;
  EXPECT_THROW(EquilibriumSolver(sphere.view(), platens), InputError);
}

// How far the middle plane of a unit sphere about the origin has moved up: the shift of the nodes near it, extrapolated
// to it.
double middle_shift(const LoadState& before, const LoadState& after) {
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < before.x.size(); ++i) {
    if (std::abs(before.x[i].z()) > 0.4) continue;
    const Eigen::Vector2d row(1.0, before.x[i].z());
    normal += row * row.transpose();
    right += (after.x[i].z() - before.x[i].z()) * row;
  }
  return normal.ldlt().solve(right)[0];
}

// Hertz with six elements over the contact radius, at the lower pole; measured from the sphere's middle, which the
// other platen's load brings nearer by f(a) F/(pi E) (Tatara 1991, J. Eng. Mater. Technol. 113, 285). A little friction
// keeps the sphere from rolling off the fine elements; it can stiffen the contact by 4 % at most, (1-nu)
// ln(3-4nu)/(1-2nu).
TEST(Equilibrium, HertzianContact) {
  const double radius = 1.0, contact = 0.08, approach_below = contact * contact / radius;
  const PressedBody sphere{.mesh = tetrahedralise(Sphere{2.0 * radius}, {.element_size = 0.22,
                                                                         .contact_element_size = contact / 6.0,
                                                                         .contact_extent = 0.16,
                                                                         .contact_points = {{0.0, 0.0, -radius}}}),
                           .material = make_material(1.0, 0.25, 1.0),
                           .friction = 0.1};
  EquilibriumSolver solver(sphere.view(), sphere.platens());
  LoadState state = solver.start();
  const LoadState start = solver.start();
  double below = 0.0;
  for (double approach = 2.0 * approach_below; below < approach_below; approach *= 1.1) {
    ASSERT_TRUE(solver.solve(state, approach));
    below = solver.height(0, approach) - solver.height(0, 0.0) - middle_shift(start, state);
  }
  const double force = solver.force(state), nu = 0.25, reach = 4.0 * radius * radius + contact * contact;
  const double f = 2.0 * (1.0 + nu) * radius * radius / std::pow(reach, 1.5) + (1.0 - nu * nu) / std::sqrt(reach);
  below += f * force / std::numbers::pi;
  const double hertz = 4.0 / 3.0 / (1.0 - nu * nu) * std::sqrt(radius) * std::pow(below, 1.5);
  EXPECT_NEAR(force, hertz, 0.05 * hertz) << 1e3 * below;
}

}  // namespace
}  // namespace knap
