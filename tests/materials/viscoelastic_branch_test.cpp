#include "materials/viscoelastic_branch.hpp"

#include <gtest/gtest.h>

namespace knap {
namespace {

const Lame elastic{1.3, 0.7};
const ViscoelasticBranch branch{0.3, 2.0};
const Mat3 held{{0.02, 0.01, 0.0}, {0.01, -0.01, 0.005}, {0.0, 0.005, 0.03}};

TEST(ViscoelasticBranch, StressRelaxesExponentiallyAtHeldStrain) {
  ViscoelasticHistory history;
  const double dt = 0.13;
  const Mat3 initial = branch_stress(branch, elastic, held);
  for (int n = 0; n < 50; ++n) {
    const Mat3 stress = advance(branch, elastic, held, dt, history).stress;
    EXPECT_LT((stress - std::exp(-(n + 0.5) * dt / 2.0) * initial).norm(), 1e-14);
  }
}

TEST(ViscoelasticBranch, AllStoredEnergyOfAHeldStrainIsDissipated) {
  ViscoelasticHistory history;
  double dissipated = 0.0;
  for (int n = 0; n < 1000; ++n) {
    const BranchResponse r = advance(branch, elastic, held, 0.1, history);
    EXPECT_GE(r.dissipated_before, 0.0);
    EXPECT_GE(r.dissipated_after, 0.0);
    dissipated += r.dissipated_before + r.dissipated_after;
  }
  const double initial = branch_energy_density(branch, elastic, held);
  EXPECT_NEAR(dissipated, initial, 1e-12 * initial);
}

// The work of the trapezoidal rule (that of leapfrog) = change of stored energy + loss, up to a relative (omega dt)^2.
TEST(ViscoelasticBranch, EnergyBalanceOfACycleClosesToSecondOrder) {
  const auto imbalance = [](int steps_a_cycle) {
    ViscoelasticHistory history;
    const double dt = 2.0 * 3.14159265358979 / steps_a_cycle;  // omega = 1
    Mat3 strain = Mat3::Zero(), stress = Mat3::Zero();
    double work = 0.0, dissipated = 0.0, pending = 0.0, stored = 0.0;
    for (int n = 0; n < 3 * steps_a_cycle; ++n) {
      const Mat3 next = std::sin(n * dt) * held;
      const BranchResponse r = advance(branch, elastic, next, dt, history);
      work += 0.5 * (stress + r.stress).cwiseProduct(next - strain).sum();
      dissipated += pending + r.dissipated_before;
      pending = r.dissipated_after;
      stored = r.stored;
      strain = next;
      stress = r.stress;
    }
    return std::abs(work - stored - dissipated) / dissipated;
  };
  EXPECT_LT(imbalance(200), 1e-3);
  EXPECT_NEAR(imbalance(400) / imbalance(200), 0.25, 0.1);
}

TEST(ViscoelasticBranch, ZeroStepLeavesTheStateAlone) {
  ViscoelasticHistory history;
  history.viscous_strain = 0.5 * held;
  const BranchResponse r = advance(branch, elastic, held, 0.0, history);
  EXPECT_EQ(history.viscous_strain, Mat3(0.5 * held));
  EXPECT_EQ(r.dissipated_before + r.dissipated_after, 0.0);
}

}  // namespace
}  // namespace knap
