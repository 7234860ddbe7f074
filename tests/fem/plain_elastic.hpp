#pragma once
// The bulk by the textbook, tet by tet through F and P, to compare the vector kernels with.
#include "fem/elastic_kernel.hpp"
#include "fem/tet_reference.hpp"
#include "materials/material.hpp"

namespace knap {

inline Mat3 gradient_of_tet(const TetReference& tet, const TetCorners& n, std::span<const Vec4> x) {
  return deformation_gradient(tet, xyz(x[at(n[0])]), xyz(x[at(n[1])]), xyz(x[at(n[2])]), xyz(x[at(n[3])]));
}

inline void add_piola(const TetReference& tet, const TetCorners& nodes, const Mat3& P, std::vector<Vec4>& f) {
  const auto gradients = shape_gradients(tet);
  for (std::size_t i = 0; i < 4; ++i) xyz(f[at(nodes[i])]) -= tet.volume * P * gradients[i];
}

inline std::vector<Vec4> plain_forces(const Topology& topology, std::span<const Vec3> reference,
                                      const Material& material, std::span<const Vec4> x) {
  std::vector<Vec4> f(x.size(), Vec4::Zero());
  for (std::size_t t = 0; t < topology.tet_nodes.size(); ++t) {
    const TetReference tet = make_tet_reference(reference, topology.tet_vertices[t]);
    const Mat3 F = gradient_of_tet(tet, topology.tet_nodes[t], x);
    add_piola(tet, topology.tet_nodes[t], std::visit([&](auto& law) { return first_piola(law, F); }, material.law), f);
  }
  return f;
}

inline double plain_energy(const Topology& topology, std::span<const Vec3> reference, const Material& material,
                           std::span<const Vec4> x) {
  double energy = 0.0;
  for (std::size_t t = 0; t < topology.tet_nodes.size(); ++t) {
    const TetReference tet = make_tet_reference(reference, topology.tet_vertices[t]);
    const Mat3 F = gradient_of_tet(tet, topology.tet_nodes[t], x);
    energy += tet.volume * std::visit([&](auto& law) { return energy_density(law, F); }, material.law);
  }
  return energy;
}

inline Mat3 plain_stress(std::span<const Vec3> reference, const Topology& topology, const Material& material,
                         std::span<const Vec4> x, Index t) {
  const TetReference tet = make_tet_reference(reference, topology.tet_vertices[at(t)]);
  const Mat3 F = gradient_of_tet(tet, topology.tet_nodes[at(t)], x);
  return std::visit([&](auto& law) { return cauchy_stress(law, F); }, material.law);
}

struct PlainBranchForces {
  std::vector<Vec4> f;
  std::vector<Mat3> stress;
  double stored = 0.0, dissipated_before = 0.0, dissipated_after = 0.0;
};

inline PlainBranchForces plain_branch_forces(const Topology& topology, std::span<const Vec3> reference,
                                             const Material& material, std::span<const Vec4> x, double dt,
                                             std::vector<ViscoelasticHistory>& history) {
  PlainBranchForces result;
  result.f = plain_forces(topology, reference, material, x);
  for (std::size_t t = 0; t < topology.tet_nodes.size(); ++t) {
    const TetReference tet = make_tet_reference(reference, topology.tet_vertices[t]);
    const Mat3 F = gradient_of_tet(tet, topology.tet_nodes[t], x);
    const BranchResponse r = advance(material.branch, material.small_strain(), green_strain(F), dt, history[t]);
    add_piola(tet, topology.tet_nodes[t], F * r.stress, result.f);
    result.stress.push_back(plain_stress(reference, topology, material, x, to_index(t)) +
                            F * r.stress * F.transpose() / F.determinant());
    result.stored += tet.volume * r.stored;
    result.dissipated_before += tet.volume * r.dissipated_before;
    result.dissipated_after += tet.volume * r.dissipated_after;
  }
  return result;
}

}  // namespace knap
