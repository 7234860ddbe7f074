#pragma once
// The tangent of the bulk's forces. It is gathered column by column from the tets around a node, each tet visited once
// for each of its corners: no two threads write the same column, and every sum has the order of the tets.
#include <Eigen/SparseCore>
#include <span>

#include "core/topology.hpp"
#include "materials/material.hpp"

namespace knap {

/// The lower triangle of a symmetric matrix by compressed columns; row and column 3 * node + axis.
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, Index>;

/// Zeros wherever a stiffness of this topology can be different from zero.
SparseMatrix stiffness_pattern(const Topology& topology);

/// -df/dx [N/m] of the long-term elastic law (without the viscoelastic branch) at positions x [m], into a matrix made
/// by stiffness_pattern. With F = sum of x_a g_a and b_a = cof F g_a, g_a the gradients of the shape functions,
///   K_ab = V (mu g_a.g_b I + U''(J) b_a b_b^T + U'(J) [F (g_a x g_b)]_x^T)
void update_stiffness(SparseMatrix& stiffness, const Topology& topology, std::span<const Vec3> reference_positions,
                      const Material& material, std::span<const Vec4> x);

/// K u of a matrix of which only the lower triangle is stored.
Eigen::VectorXd symmetric_product(const SparseMatrix& lower, const Eigen::VectorXd& u);

}  // namespace knap
