#include "time/rigid_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace knap {
namespace {

// A body with these principal moments [kg m2] about axes turned away from the body axes, as a fragment has them.
RigidBody make_body(const Vec3& moments) {
  const Mat3 axes = Eigen::Quaterniond(0.6, 0.2, -0.4, 0.7).normalized().toRotationMatrix();
  RigidBody body;
  body.mass = 2.0;
  body.inertia = axes * moments.asDiagonal() * axes.transpose();
  body.inverse_inertia = axes * moments.cwiseInverse().asDiagonal() * axes.transpose();
  update_inertia(body);
  return body;
}

Vec3 principal_axis(const RigidBody& body, int i) {
  const Mat3 axes = Eigen::Quaterniond(0.6, 0.2, -0.4, 0.7).normalized().toRotationMatrix();
  return body.orientation * axes.col(i);
}

// The intermediate axis is unstable: a body that starts to turn about it somersaults for ever (Dzhanibekov's wing nut).
TEST(RigidMotion, TumblingKeepsEnergyAndAngularMomentum) {
  RigidBody body = make_body({1.0, 2.0, 3.0});
  body.angular_momentum = 2.0 * principal_axis(body, 1) + 1e-3 * principal_axis(body, 0);
  const Vec3 momentum = body.angular_momentum;
  const double energy = kinetic_energy(body);
  const double dt = 0.02;  // about a degree
  int somersaults = 0;
  double side = 1.0, largest = 0.0;
  for (int i = 0; i < 100000; ++i) {
    rotate_freely(body, dt);
    largest = std::max(largest, std::abs(kinetic_energy(body) / energy - 1.0));
    const double now = principal_axis(body, 1).dot(momentum);
    if (now * side < 0.0) {
      ++somersaults;
      side = -side;
    }
  }
  EXPECT_GT(somersaults, 60);
  EXPECT_EQ(body.angular_momentum, momentum);
  EXPECT_LT(largest, 1e-11);  // round-off of 1e5 orientations
  EXPECT_NEAR(body.orientation.norm(), 1.0, 1e-15);
}

/// Axis of a symmetric top after time t: it precesses about the angular momentum at |L|/A.
double error_of_symmetric_top(double dt, double time) {
  const double A = 1.0, C = 2.5;
  RigidBody body = make_body({A, A, C});
  const Vec3 start = principal_axis(body, 2), mark = principal_axis(body, 0);
  body.angular_momentum = C * 0.8 * start + A * 0.9 * mark;
  const Vec3 momentum = body.angular_momentum;
  const int steps = static_cast<int>(std::lround(time / dt));
  for (int i = 0; i < steps; ++i) rotate_freely(body, dt);
  // The body turns about its axis at w3 (1 - C/A), seen from a frame that precesses with the axis.
  const Eigen::AngleAxisd precession(time * momentum.norm() / A, momentum.normalized());
  const Eigen::AngleAxisd own(time * 0.8 * (1.0 - C / A), start);
  const Vec3 expected = precession * (own * mark);
  return std::max((principal_axis(body, 2) - precession * start).norm(), (principal_axis(body, 0) - expected).norm());
}

TEST(RigidMotion, SymmetricTopFollowsItsClosedFormToFourthOrder) {
  const double coarse = error_of_symmetric_top(0.05, 20.0), fine = error_of_symmetric_top(0.025, 20.0);
  EXPECT_LT(coarse, 2e-5);
  EXPECT_NEAR(std::log2(coarse / fine), 4.0, 0.1);
}

TEST(RigidMotion, GeneralBodyConvergesToFourthOrder) {
  const auto orientation = [](int steps) {
    RigidBody body = make_body({0.7, 1.9, 2.3});
    body.angular_momentum = {1.0, -0.6, 0.8};
    for (int i = 0; i < steps; ++i) rotate_freely(body, 20.0 / steps);
    return body.orientation;
  };
  const auto exact = orientation(20000);
  const double coarse = exact.angularDistance(orientation(400)), fine = exact.angularDistance(orientation(800));
  EXPECT_LT(coarse, 2e-5);
  EXPECT_NEAR(std::log2(coarse / fine), 4.0, 0.1);
}

TEST(RigidMotion, FallsFreely) {
  RigidBodies rigid;
  rigid.bodies.push_back(make_body({1.0, 1.0, 1.0}));
  rigid.bodies[0].velocity = {1.0, 0.0, 0.0};
  const double dt = 1e-3;
  for (int i = 0; i < 1000; ++i) {
    kick(rigid, {0.0, 0.0, -9.81}, dt);
    drift(rigid, dt);
  }
  EXPECT_NEAR(rigid.bodies[0].centre.x(), 1.0, 1e-12);
  EXPECT_NEAR(rigid.bodies[0].centre.z(), -0.5 * 9.81 * 1.001, 1e-12);  // velocities of half steps: (n + 1)/n
  EXPECT_NEAR(rigid.bodies[0].velocity_before.z(), -9.81 * 0.999, 1e-12);
}

}  // namespace
}  // namespace knap
