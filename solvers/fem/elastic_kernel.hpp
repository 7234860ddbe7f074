#pragma once
// Vector kernels of the bulk sweeps over one block of tets, compiled for several instruction sets and chosen at run
// time.
//
// They work in the metric of the tet's edges instead of F. With D the matrix of current edges d1 d2 d3, V the reference
// volume and G the inverse of the reference edges' metric D0^T D0, a law P = mu F + s(J) cof F gives the corner forces
//   [f1 f2 f3] = -V P D0^-T = -(D (mu V G) + s/6 cof D),   J = det D / (6V),   f0 = -(f1 + f2 + f3)
// exactly, because F D0^-T = D G and cof(D0^-1) D0^-T = I/(6V): 7 numbers a tet instead of 10 and half the arithmetic
// of the way through F and P. Likewise F F^T = D G D^T and F:F = G : D^T D. The viscoelastic branch in Green strain
// adds its stress to mu V G: with the metric B that the branch has relaxed to, its elastic strain is (D^T D - B)/2 in
// edge components, B(0) = D0^T D0 and dB/dt = (D^T D - B)/tau.
#include <algorithm>

#include "core/tet_stress.hpp"
#include "fem/element_blocks.hpp"

namespace knap {

/// Components of a symmetric matrix in the order 11, 22, 33, 23, 31, 12, each for a lane group of tets.
using SymmetricLanes = std::array<std::array<double, std::size_t{lanes}>, 6>;

/// Reference data of a lane group; all zero in padding lanes.
struct alignas(64) ElementGroup {
  SymmetricLanes stiffness{};                                   ///< -mu V G [N/m]
  std::array<double, std::size_t{lanes}> inverse_six_volume{};  ///< 1/(6V) [1/m3]
};

/// State of the viscoelastic branch of a lane group.
struct alignas(64) BranchGroup {
  SymmetricLanes relaxed_metric{};  ///< B [m2], at half steps
};

/// The numbers of neo-Hookean law and branch, as the kernels use them.
struct KernelCoefficients {
  double mu = 0.0;            ///< [Pa]
  double lambda_plus_mu = 0;  ///< [Pa]
  double branch_trace = 0.0;  ///< 6 ratio lambda/mu^2 [1/Pa]
  double branch_shear = 0.0;  ///< 12 ratio/mu [1/Pa]
  double decay = 1.0;         ///< half-step decay of the branch's elastic strain [-]
};

/// Of one block or of all tets.
struct BulkState {
  double strain_energy = 0.0;          ///< branch included [J]
  double smallest_volume_ratio = 1.0;  ///< J of the most compressed tet [-], <= 0 = a tet is inverted

  BulkState& operator+=(const BulkState& other) {
    strain_energy += other.strain_energy;
    smallest_volume_ratio = std::min(smallest_volume_ratio, other.smallest_volume_ratio);
    return *this;
  }
};

/// One block as the kernels see it; positions are padded vectors by node [m].
struct BlockView {
  const ElementGroup* groups = nullptr;
  BranchGroup* branch = nullptr;  ///< null = no branch
  const LocalCorners* corners = nullptr;
  const ElementBlock* block = nullptr;
  const double* x = nullptr;
};

/// Forces [N] of the block: private nodes into f by node, shared ones into its slots; relaxes the branch by one step.
/// Returns the energy stored in the branch [J].
double add_block_forces(const BlockView& view, const KernelCoefficients& k, double* f, double* slots);
BulkState block_state(const BlockView& view, const KernelCoefficients& k);
/// Cauchy stress of the block's tets into stress[tet], its Frobenius norm, rounded up, into bound[tet].
void store_block_stress(const BlockView& view, const KernelCoefficients& k, TetStress* stress, float* bound);

}  // namespace knap
