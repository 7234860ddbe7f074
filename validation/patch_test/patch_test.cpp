// A body of irregular tets under a homogeneous deformation: the stress in every tet is that of the law at this
// deformation, and no force acts on any interior node.
#include "fem/elastic_force.hpp"
#include "tests/fem/grid_mesh.hpp"
#include "validation/problems.hpp"

namespace knap {
namespace {

constexpr double poisson_ratio = 0.25;

// Cauchy stress over Young's modulus of W = mu/2 (F:F - 3) - mu (J - 1) + (lambda + mu)/2 (J - 1)^2, written out here.
Mat3 stress_of(const Mat3& F) {
  const double lambda = poisson_ratio / ((1.0 + poisson_ratio) * (1.0 - 2.0 * poisson_ratio));
  const double mu = 0.5 / (1.0 + poisson_ratio);
  const double J = F.determinant();
  return mu / J * F * F.transpose() + ((lambda + mu) * (J - 1.0) - mu) * Mat3::Identity();
}

struct Patch {
  double stress_error = 0.0;  // over the stress [-]
  double force_error = 0.0;   // over stress times the area of a face of a cell [-]
};

Patch patch(const Mat3& F) {
  constexpr Index cells = 6;
  const TetMesh mesh = grid_mesh(cells, 1.0, 0.15);
  const Topology topology = make_topology(mesh);
  ElasticForce elastic = make_elastic_force(topology, mesh.vertices, make_material(1.0, poisson_ratio, 1.0));
  std::vector<Vec4> x, f(mesh.vertices.size());
  for (const Vec3& v : mesh.vertices) x.push_back(padded(F * v));
  update_elastic_forces(elastic, x, f, 0.0);
  update_stress(elastic, x);
  const Mat3 exact = stress_of(F);
  Patch result;
  for (const TetStress& stress : elastic.stress)
    result.stress_error = std::max(result.stress_error, (as_matrix(stress) - exact).norm() / exact.norm());
  for (std::size_t i = 0; i < f.size(); ++i) {
    const Vec3& v = mesh.vertices[i];
    if (v.minCoeff() > 0.0 && v.maxCoeff() < 1.0)
      result.force_error = std::max(result.force_error, f[i].norm() * cells * cells / exact.norm());
  }
  return result;
}

}  // namespace

void show_patch_test(Evidence& evidence) {
  const Mat3 direction{{1.0, 0.3, -0.2}, {0.5, -0.7, 0.1}, {0.2, 0.4, 0.6}};
  PlotSeries stress{.name = "stress", .style = PlotSeries::Style::Points}, force{.name = "force on interior nodes"};
  force.style = PlotSeries::Style::Points;
  double largest_stress = 0.0, largest_force = 0.0;
  for (const double strain : {1e-4, 1e-3, 1e-2, 0.05, 0.2}) {
    const Patch result = patch(Mat3::Identity() + strain * direction);
    // The law's terms are of the size of the modulus: cancellation costs digits in proportion to 1/strain.
    const double scale = std::min(1.0, strain);
    stress.x.push_back(strain), stress.y.push_back(result.stress_error);
    force.x.push_back(strain), force.y.push_back(result.force_error);
    largest_stress = std::max(largest_stress, scale * result.stress_error);
    largest_force = std::max(largest_force, scale * result.force_error);
  }
  evidence.at_most("error of stress over modulus [-]", largest_stress, 1e-10, "round-off");
  evidence.at_most("force on interior nodes over modulus [-]", largest_force, 1e-10, "round-off");
  evidence.curve({{"strain [-]", stress.x}, {"stress error [-]", stress.y}, {"force error [-]", force.y}});
  evidence.plot({.title = "Patch test: homogeneous deformation of an irregular mesh",
                 .x_label = "strain [-]",
                 .y_label = "largest error over the stress [-]",
                 .series = {stress, force},
                 .log_x = true,
                 .log_y = true});
}

}  // namespace knap
