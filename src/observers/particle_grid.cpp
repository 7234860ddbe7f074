#include "observers/particle_grid.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "observers/fragment_census.hpp"

namespace knap {
namespace {

std::vector<TetStress> stress_now(const Simulation& s) {
  ElasticForce elastic = s.elastic;  // a look must not touch the run
  update_stress(elastic, s.nodes.x);
  return std::move(elastic.stress);
}

double von_mises(const TetStress& a) {
  const double normal = std::pow(a.xx - a.yy, 2) + std::pow(a.yy - a.zz, 2) + std::pow(a.zz - a.xx, 2);
  return std::sqrt(0.5 * normal + 3.0 * (a.xy * a.xy + a.yz * a.yz + a.zx * a.zx));
}

double largest_principal(const TetStress& a) {
  Mat3 tensor;
  tensor << a.xx, a.xy, a.zx, a.xy, a.yy, a.yz, a.zx, a.yz, a.zz;
  Eigen::SelfAdjointEigenSolver<Mat3> solver;
  solver.computeDirect(tensor, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[2];
}

void add_stress(VtkGrid& grid, const std::vector<TetStress>& stress) {
  VtkField tensor{"stress [Pa]", 6, {}};  // in VTK's order of a symmetric tensor: xx yy zz xy yz xz
  VtkField mises{"von_mises [Pa]", 1, {}};
  VtkField principal{"largest_principal_stress [Pa]", 1, {}};
  for (const TetStress& a : stress) {
    tensor.values.insert(tensor.values.end(), {a.xx, a.yy, a.zz, a.xy, a.yz, a.zx});
    mises.values.push_back(von_mises(a));
    principal.values.push_back(largest_principal(a));
  }
  grid.cell_fields.insert(grid.cell_fields.end(), {std::move(tensor), std::move(mises), std::move(principal)});
}

void add_nodal_fields(VtkGrid& grid, const Simulation& s) {
  VtkField velocity{"velocity [m/s]", 3, {}};
  VtkField displacement{"displacement [m]", 3, {}};
  const auto append = [](VtkField& field, const Vec3& a) {
    field.values.insert(field.values.end(), {a.x(), a.y(), a.z()});
  };
  for (Index i = 0; i < s.nodes.size(); ++i) {
    const Vec3 x = xyz(s.nodes.x[at(i)]);
    grid.points.push_back(x);
    append(velocity, xyz(s.nodes.v[at(i)]));
    append(displacement, x - s.reference.vertices[at(s.topology.vertex_of_node[at(i)])]);
  }
  grid.point_fields = {std::move(velocity), std::move(displacement)};
}

}  // namespace

VtkGrid particle_grid(const Simulation& s, const Relabel& relabel) {
  VtkGrid grid;
  grid.tets = s.topology.tet_nodes;
  add_nodal_fields(grid, s);
  const auto labels = [&](FragmentLabel label) {
    return relabel(fragment_labels(s.topology, s.cracks, label), s.reference.tet_volume);
  };
  grid.cell_int_fields = {{"fragment", 1, labels(FragmentLabel::Damage)},
                          {"fragment_strict", 1, labels(FragmentLabel::Strict)},
                          {"particle", 1, s.reference.particle_of_tet}};
  grid.cell_fields = {{"damage [-]", 1, tet_damage(s)}};
  add_stress(grid, stress_now(s));
  return grid;
}

}  // namespace knap
