#pragma once
// The largest stable step of the explicit scheme from a bound at every node. A diagonal matrix that dominates the
// stiffness of each tet, K_e <= diag(k_i), dominates their sum, so omega^2 <= max over nodes of (sum of k_i)/m,
// whatever is connected: cracks, free surfaces, single tets.
#include <span>

#include "core/topology.hpp"
#include "materials/material.hpp"

namespace knap {

/// Which modulus the bound of a tet uses.
enum class StiffnessBound {
  Rigorous,   ///< holds for any piece: largest eigenvalue of the tet's stiffness in the scaled corner displacements
  PlaneWave,  ///< c_e (lambda + 2 mu): inside a body only; a dilating single tet exceeds it
};

/// Scalar stiffness k of every corner [N/m], by corner = 4 * tet + local index, at small strain, branch included.
std::vector<double> corner_stiffnesses(std::span<const TetCorners> tets, std::span<const Vec3> reference_positions,
                                       const Material& material, StiffnessBound bound = StiffnessBound::Rigorous);

/// Upper bound of omega^2 [1/s2] at a node of mass [kg] made of the given corners.
double nodal_frequency_bound2(std::span<const Index> corners, std::span<const double> corner_stiffnesses, double mass);

/// Smallest mass [kg] a node made of the given corners needs for a critical step of dt [s].
double smallest_mass(std::span<const Index> corners, std::span<const double> corner_stiffnesses, double dt);

/// Critical step 2/omega [s] of the whole topology; masses by node [kg].
double critical_time_step(const Topology& topology, std::span<const double> corner_stiffnesses,
                          std::span<const double> masses);

}  // namespace knap
