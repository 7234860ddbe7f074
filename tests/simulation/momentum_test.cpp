#include <gtest/gtest.h>

#include "cohesive/crack_faces.hpp"
#include "cohesive/fragments.hpp"
#include "simulation/step.hpp"
#include "tests/support/granule.hpp"

namespace knap {
namespace {

// A free particle that flies apart by its own spin: the rim's 100 m/s put several MPa on a strength of 1 MPa.
TEST(Momentum, KeptByAnIsolatedBreakingSpinner) {
  Granule granule{.element_size = 0.2e-3, .contact_element_size = 0.2e-3};
  granule.options.fracture = zeolite_fracture();
  granule.options.fracture->strength = 1e6;
  granule.options.fracture->fracture_energy = 0.5;
  granule.options.velocity = {5.0, 0.0, 3.0};
  granule.options.spin = {0.0, 1.3e5, 2e4};
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

// Galilean invariance: on a frictionless wall, damage depends on v sin(theta) only. Round-off grows along the way, so
// the two runs part in details at last; while the particle breaks they are the same facet by facet.
TEST(Momentum, FrictionlessObliqueImpactIsTheNormalImpact) {
  const auto impact = [](double tangential) {
    Granule granule{.element_size = 0.2e-3, .contact_element_size = 0.12e-3};
    granule.options.fracture = zeolite_fracture();
    granule.options.wall = Plane{};
    granule.options.velocity = {tangential, 0.0, -20.0};
    Simulation s = make_granule(granule);
    while (s.clock.time() < 2.5e-6) EXPECT_EQ(step(s), StepStatus::Ok);
    return s;
  };
  const Simulation normal = impact(0.0), oblique = impact(20.0);
  EXPECT_GT(normal.totals.inserted_facets, 400);
  EXPECT_EQ(normal.topology.facet_state, oblique.topology.facet_state);
  for (const FragmentLabel label : {FragmentLabel::Strict, FragmentLabel::Damage})
    EXPECT_EQ(fragment_labels(normal.topology, normal.cracks, label),
              fragment_labels(oblique.topology, oblique.cracks, label));
}

}  // namespace
}  // namespace knap
