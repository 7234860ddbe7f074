// A sphere under uniform radial pressure on two polar caps of 10 degrees, in equilibrium: the stress on its axis. The
// load is one step of the linear problem, with displacements too small for anything else; nothing of it but the
// stiffness is the program's, so stiffness and stress are what is shown. F is the resultant along the axis.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/errors.hpp"
#include "fem/elastic_force.hpp"
#include "meshing/tetrahedralise.hpp"
#include "quasistatic/sparse_cholesky.hpp"
#include "validation/problems.hpp"

namespace knap {
namespace {

constexpr double cap_cosine = 0.98480775301220802;  // cos 10 degrees

struct Body {
  TetMesh mesh;
  Topology topology = make_topology(mesh);
};

Body sphere_graded_to_caps() {
  return {tetrahedralise(Sphere{2.0}, {.element_size = 0.1,
                                       .contact_element_size = 0.03,
                                       .contact_extent = 0.2,
                                       .contact_points = {{0, 0, 1}, {0, 0, -1}, {0, 0, 0.85}, {0, 0, -0.85}}})};
}

// Nodal forces of a unit pressure on the caps: each face cut in small triangles, of which the caps have some.
Eigen::VectorXd cap_load(const Body& body) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(3 * body.topology.num_nodes());
  constexpr int cuts = 24;
  for (const Index corner : body.topology.outer_facets) {
    const TetCorners& tet = body.topology.tet_nodes[at(corner >> 2)];
    std::array<Index, 3> nodes{};
    for (std::size_t k = 0; k < 3; ++k) nodes[k] = tet[at(facet_of_corner[at(corner & 3)][k])];
    const Vec3 &a = body.mesh.vertices[at(nodes[0])], &b = body.mesh.vertices[at(nodes[1])],
               &c = body.mesh.vertices[at(nodes[2])];
    if (std::abs((a + b + c).normalized().z()) < cap_cosine - 0.1) continue;
    const double area = 0.5 * (b - a).cross(c - a).norm() / (cuts * cuts);
    for (int i = 0; i < cuts; ++i)
      for (int j = 0; j < 2 * (cuts - i) - 1; ++j) {  // upright and inverted triangles of row i, by turns
        const double shift = j % 2 == 0 ? 1.0 / 3.0 : 2.0 / 3.0;
        const double u = (i + shift) / cuts, v = (j / 2 + shift) / cuts;
        const Vec3 weights(1.0 - u - v, u, v);
        const Vec3 normal = (weights[0] * a + weights[1] * b + weights[2] * c).normalized();
        if (std::abs(normal.z()) < cap_cosine) continue;
        for (std::size_t k = 0; k < 3; ++k)
          load.segment<3>(3 * nodes[k]) -= weights[static_cast<Eigen::Index>(k)] * area * normal;
      }
  }
  return load;
}

// The load without what would move or turn the body: the caps' meshes are not quite alike.
Eigen::VectorXd balanced(const Body& body, const Eigen::VectorXd& load) {
  Eigen::MatrixXd rigid(load.size(), 6);
  for (Index i = 0; i < body.topology.num_nodes(); ++i)
    for (int k = 0; k < 3; ++k) {
      rigid.block<3, 1>(3 * i, k) = Vec3::Unit(k);
      rigid.block<3, 1>(3 * i, 3 + k) = Vec3::Unit(k).cross(body.mesh.vertices[at(i)]);
    }
  const Eigen::MatrixXd q = rigid.householderQr().householderQ() * Eigen::MatrixXd::Identity(load.size(), 6);
  return load - q * (q.transpose() * load);
}

// Stress by tet, of a unit pressure and a unit modulus. Springs on six unknowns hold the body; they carry nothing.
std::vector<TetStress> stresses(const Body& body, double nu, const Eigen::VectorXd& load) {
  const Material material = make_material(1.0, nu, 1.0);
  std::vector<Vec4> x, f(body.mesh.vertices.size());
  for (const Vec3& v : body.mesh.vertices) x.push_back(padded(v));
  SparseMatrix stiffness = stiffness_pattern(body.topology);
  update_stiffness(stiffness, body.topology, body.mesh.vertices, material, x);
  const auto extreme = [&](int axis) {
    const auto& v = body.mesh.vertices;
    return to_index(static_cast<std::size_t>(
        std::max_element(v.begin(), v.end(), [axis](auto& p, auto& q) { return p[axis] < q[axis]; }) - v.begin()));
  };
  const Index a = extreme(0), b = extreme(1), c = extreme(2);
  for (const Index unknown : {3 * a, 3 * a + 1, 3 * a + 2, 3 * b, 3 * b + 2, 3 * c + 1})
    stiffness.coeffRef(unknown, unknown) *= 2.0;
  SparseCholesky cholesky(stiffness);
  if (!cholesky.factorise(stiffness)) throw RuntimeFailure("the stiffness is not positive definite");
  constexpr double pressure = 1e-6;  // of the modulus: errors of finite strain, and of round-off, stay below it
  const Eigen::VectorXd u = pressure * cholesky.solve(load);
  for (std::size_t i = 0; i < x.size(); ++i) x[i].head<3>() += u.segment<3>(3 * static_cast<Eigen::Index>(i));
  ElasticForce elastic = make_elastic_force(body.topology, body.mesh.vertices, material);
  update_elastic_forces(elastic, x, f, 0.0);
  update_stress(elastic, x);
  for (TetStress& stress : elastic.stress)
    for (double* s : {&stress.xx, &stress.yy, &stress.zz, &stress.xy, &stress.yz, &stress.zx}) *s /= pressure;
  return elastic.stress;
}

/// On the axis: along it, and the mean of both directions across it.
struct AxisStress {
  double radial = 0.0, tangential = 0.0;
};

// By a linear fit over the tets around a height on the axis.
AxisStress fitted(const Body& body, std::span<const TetStress> stress, double height) {
  const double r = std::abs(height), reach = r > 0.6 ? 0.04 : r > 0.4 ? 0.07 : 0.1;  // one and a half elements
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero(), right = Eigen::Matrix2d::Zero();
  for (std::size_t t = 0; t < stress.size(); ++t) {
    Vec3 middle = Vec3::Zero();
    for (const Index v : body.mesh.tets[t]) middle += 0.25 * body.mesh.vertices[at(v)];
    const double ahead = middle.z() - height;
    if (middle.head<2>().squaredNorm() + ahead * ahead > reach * reach) continue;
    const double volume = tet_volume(body.mesh, to_index(t));
    const Eigen::Vector2d row(1.0, ahead);
    normal += volume * row * row.transpose();
    right += volume * row * Eigen::RowVector2d(stress[t].zz, 0.5 * (stress[t].xx + stress[t].yy));
  }
  const Eigen::Matrix2d fit = normal.ldlt().solve(right);
  return {fit(0, 0), fit(0, 1)};
}

// The mean of both halves.
AxisStress axis_stress(const Body& body, std::span<const TetStress> stress, double r) {
  const AxisStress above = fitted(body, stress, r), below = fitted(body, stress, -r);
  return {0.5 * (above.radial + below.radial), 0.5 * (above.tangential + below.tangential)};
}

/// Columns over r/R for one nu, all times pi R^2/F.
struct Axis {
  std::vector<double> r{}, radial{}, tangential{}, exact_radial{}, exact_tangential{};
};

Axis axis_of(const Evidence& evidence, const Body& body, double nu, const Eigen::VectorXd& load) {
  const CsvColumns reference = evidence.reference();
  const auto stress = stresses(body, nu, balanced(body, load));
  double force = 0.0;
  for (Eigen::Index i = 2; i < load.size(); i += 3) force += 0.5 * std::abs(load[i]);
  const double scale = std::numbers::pi / force;
  Axis axis;
  for (std::size_t i = 0; i < reference.values[0].size(); ++i) {
    if (reference.column("nu")[i] != nu) continue;
    axis.r.push_back(reference.column("r_over_R")[i]);
    const AxisStress found = axis_stress(body, stress, axis.r.back());
    axis.radial.push_back(scale * found.radial), axis.tangential.push_back(scale * found.tangential);
    axis.exact_radial.push_back(reference.column("sigma_rr_piR2_over_F")[i]);
    axis.exact_tangential.push_back(reference.column("sigma_tt_piR2_over_F")[i]);
  }
  return axis;
}

void compare(Evidence& evidence, double nu, const Axis& axis) {
  const auto smallest = [](const std::vector<double>& v) { return *std::min_element(v.begin(), v.end()); };
  const auto largest = [](const std::vector<double>& v) { return *std::max_element(v.begin(), v.end()); };
  const std::string centre = "physics.md section 3", most = "physics.md section 3, elements of 0.03 R at the caps";
  const auto name = [nu](const char* what) { return fmt::format("nu {}: {}, over F/(pi R^2) [-]", nu, what); };
  evidence.relative(name("radial at the centre"), axis.radial[0], axis.exact_radial[0], 0.02, centre);
  evidence.relative(name("tangential at the centre"), axis.tangential[0], axis.exact_tangential[0], 0.02, centre);
  evidence.relative(name("largest pressure"), smallest(axis.radial), smallest(axis.exact_radial), 0.1, most);
  evidence.relative(name("largest tension"), largest(axis.tangential), largest(axis.exact_tangential), 0.1, most);
  double worst = 0.0;
  for (std::size_t i = 0; i < axis.r.size(); ++i)
    worst = std::max({worst, std::abs(axis.radial[i] - axis.exact_radial[i]),
                      std::abs(axis.tangential[i] - axis.exact_tangential[i])});
  evidence.at_most(fmt::format("nu {}: largest difference on the axis over the largest pressure [-]", nu),
                   -worst / smallest(axis.exact_radial), 0.1, most);
}

}  // namespace

void show_hiramatsu_oka(Evidence& evidence) {
  const Body body = sphere_graded_to_caps();
  const Eigen::VectorXd load = cap_load(body);
  std::vector<double> nus{0.25};
  if (!evidence.is_short()) nus = {0.2, 0.25, 0.3};
  std::vector<Column> columns;
  PlotInput plot{.title = "Sphere under two polar caps of 10 degrees: stress on its axis, nu = 0.25",
                 .x_label = "r/R [-]",
                 .y_label = "stress pi R^2/F [-]"};
  for (const double nu : nus) {
    const Axis axis = axis_of(evidence, body, nu, load);
    compare(evidence, nu, axis);
    if (columns.empty()) columns.push_back({"r/R [-]", axis.r});
    columns.push_back({fmt::format("radial, nu {} [-]", nu), axis.radial});
    columns.push_back({fmt::format("tangential, nu {} [-]", nu), axis.tangential});
    if (nu != 0.25) continue;
    plot.series = {{"radial", axis.r, axis.radial, PlotSeries::Style::Points},
                   {"tangential", axis.r, axis.tangential, PlotSeries::Style::Points},
                   {"radial, series", axis.r, axis.exact_radial, PlotSeries::Style::Dashes},
                   {"tangential, series", axis.r, axis.exact_tangential, PlotSeries::Style::Dashes}};
  }
  evidence.tell("tets", body.mesh.num_tets(), "of the sphere");
  evidence.curve(columns);
  evidence.plot(plot);
}

}  // namespace knap
