#include <gtest/gtest.h>

#include <random>

#include "cohesive/crack_faces.hpp"
#include "cohesive/fragments.hpp"
#include "simulation/step.hpp"
#include "tests/support/granule.hpp"

namespace knap {
namespace {

// A free particle that flies apart by its own spin: the rim's 100 m/s put several MPa on a strength of 1 MPa.
TEST(Momentum, KeptByAnIsolatedBreakingSpinner) {
  Granule granule{.element_size = 0.2e-3, .contact_element_size = 0.2e-3};
  granule.particle.fracture = zeolite_fracture();
  granule.particle.fracture->strength = 1e6;
  granule.particle.fracture->fracture_energy = 0.5;
  granule.particle.velocity = {5.0, 0.0, 3.0};
  granule.particle.spin = {0.0, 1.3e5, 2e4};
  Simulation s = make_granule(granule);
  for (int i = 0; i < 1500; ++i) ASSERT_EQ(step(s), StepStatus::Ok);
  EXPECT_GT(num_fragments(fragment_labels(s.topology, s.cracks, FragmentLabel::Strict)), 10);
  const Momentum now = momentum(s.nodes);
  const Momentum& start = s.reference.start;
  EXPECT_LT((now.linear - start.linear - s.totals.added_linear).norm() / start.linear.norm(), 1e-12);
  // What is on its way back belongs to the particle; even without it the error stays below 1e-4.
  const Vec3 lost = now.angular - start.angular - s.totals.added_angular;
  const double own = s.reference.start.angular.norm();
  EXPECT_LT((lost - pending_angular_momentum(s.cracks)).norm() / own, 1e-5);
  EXPECT_LT(lost.norm() / own, 1e-4);
  EXPECT_LT(s.ledger.max_closure_error, 1e-3);
}

// Largest difference of two runs' nodal velocities, the second seen from a frame that moves [m/s].
double largest_difference(const Simulation& a, const Simulation& b, const Vec3& frame) {
  double largest = 0.0;
  for (Index i = 0; i < a.nodes.size(); ++i)
    largest = std::max(largest, (xyz(b.nodes.v[at(i)]) - frame - xyz(a.nodes.v[at(i)])).norm());
  return largest;
}

// Galilean invariance: on a frictionless wall, damage depends on v sin(theta) only. Round-off grows; a twin of the
// normal run disturbed by 1e-15 shows by how much. A wall friction of 1e-9 would fail at 15 facets; a limit of the
// shear in full tension that is the root of round-off instead of zero would fail at the end (3e-7).
TEST(Momentum, FrictionlessObliqueImpactIsTheNormalImpact) {
  const double speed = 20.0;
  const auto impact = [&](double tangential) {
    Granule granule{.element_size = 0.2e-3, .contact_element_size = 0.12e-3};
    granule.particle.fracture = zeolite_fracture();
    granule.options.tools = {wall()};
    granule.particle.velocity = {tangential, 0.0, -speed};
    return make_granule(granule);
  };
  Simulation normal = impact(0.0), oblique = impact(speed), twin = impact(0.0);
  std::mt19937_64 random{1};
  std::uniform_real_distribution<double> perturbation{-1e-15 * speed, 1e-15 * speed};
  for (Vec4& v : twin.nodes.v) v += padded({perturbation(random), perturbation(random), perturbation(random)});

  double difference = 0.0, growth = 0.0;  // largest so far, over the speed
  const auto step_all = [&] {
    for (Simulation* s : {&normal, &oblique, &twin}) ASSERT_EQ(step(*s), StepStatus::Ok);
    ASSERT_EQ(normal.nodes.size(), oblique.nodes.size());
    ASSERT_EQ(normal.nodes.size(), twin.nodes.size());
    difference = std::max(difference, largest_difference(normal, oblique, {speed, 0.0, 0.0}) / speed);
    growth = std::max(growth, largest_difference(normal, twin, Vec3::Zero()) / speed);
  };
  while (normal.totals.inserted_facets < 15) ASSERT_NO_FATAL_FAILURE(step_all());
  EXPECT_LT(growth, 1e-11);
  EXPECT_LT(difference, 100.0 * growth);
  while (normal.clock.time() < 2.5e-6) ASSERT_NO_FATAL_FAILURE(step_all());
  EXPECT_LT(difference, 100.0 * growth);
  EXPECT_LT(difference, 1e-8);

  EXPECT_GT(normal.totals.inserted_facets, 400);
  EXPECT_EQ(normal.topology.facet_state, oblique.topology.facet_state);
  for (const FragmentLabel label : {FragmentLabel::Strict, FragmentLabel::Damage})
    EXPECT_EQ(fragment_labels(normal.topology, normal.cracks, label),
              fragment_labels(oblique.topology, oblique.cracks, label));
}

}  // namespace
}  // namespace knap
