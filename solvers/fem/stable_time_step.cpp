#include "fem/stable_time_step.hpp"

#include <algorithm>
#include <cmath>

#include "fem/tet_reference.hpp"

namespace knap {
namespace {

double largest_eigenvalue(const Mat3& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Mat3>(symmetric, Eigen::EigenvaluesOnly).eigenvalues()[2];
}

// Largest eigenvalue [Pa] of the elastic energy per volume in y_i = |grad N_i| u_i. With Q = sum of the normalised
// g g^T, of eigenvalues q, the strain operator squared is s -> sym(s Q): in the axes of Q its shear parts have
// mu (q_i + q_j) and its diagonal part is sqrt(q) (lambda 1 1^T + 2 mu I) sqrt(q), which has the largest one.
double modulus(const std::array<Vec3, 4>& gradients, const Lame& l, StiffnessBound bound) {
  Mat3 Q = Mat3::Zero();
  for (const Vec3& g : gradients) Q += g * g.transpose() / g.squaredNorm();
  const Vec3 q = Eigen::SelfAdjointEigenSolver<Mat3>(Q, Eigen::EigenvaluesOnly).eigenvalues().cwiseMax(0.0);
  if (bound == StiffnessBound::PlaneWave) return q[2] * p_wave_modulus(l);
  const Vec3 root = q.cwiseSqrt();
  Mat3 diagonal_part = l.lambda * root * root.transpose();
  diagonal_part.diagonal() += 2.0 * l.mu * q;
  return largest_eigenvalue(diagonal_part);
}

}  // namespace

std::vector<double> corner_stiffnesses(std::span<const TetCorners> tets, std::span<const Vec3> reference_positions,
                                       const Material& material, StiffnessBound bound) {
  std::vector<double> stiffness;
  stiffness.reserve(4 * tets.size());
  for (const TetCorners& corners : tets) {
    const TetReference tet = make_tet_reference(reference_positions, corners);
    const auto gradients = shape_gradients(tet);
    const double scale = tet.volume * material.stiffness_ratio() * modulus(gradients, material.small_strain(), bound);
    for (const Vec3& g : gradients) stiffness.push_back(scale * g.squaredNorm());
  }
  return stiffness;
}

double nodal_frequency_bound2(std::span<const Index> corners, std::span<const double> corner_stiffnesses, double mass) {
  double sum = 0.0;
  for (const Index corner : corners) sum += corner_stiffnesses[at(corner)];
  return sum / mass;
}

double smallest_mass(std::span<const Index> corners, std::span<const double> corner_stiffnesses, double dt) {
  return 0.25 * dt * dt * nodal_frequency_bound2(corners, corner_stiffnesses, 1.0);
}

double critical_time_step(const Topology& topology, std::span<const double> corner_stiffnesses,
                          std::span<const double> masses) {
  std::vector<double> stiffness(masses.size(), 0.0);
  for (Index corner = 0; corner < 4 * topology.num_tets(); ++corner)
    stiffness[at(topology.node_of_corner(corner))] += corner_stiffnesses[at(corner)];
  double omega2 = 0.0;
  for (std::size_t i = 0; i < masses.size(); ++i)
    if (masses[i] > 0.0) omega2 = std::max(omega2, stiffness[i] / masses[i]);
  return 2.0 / std::sqrt(omega2);
}

}  // namespace knap
