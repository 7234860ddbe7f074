#include "quasistatic/modes.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/errors.hpp"
#include "fem/lumped_mass.hpp"
#include "fem/tet_reference.hpp"
#include "meshing/tetrahedralise.hpp"
#include "tests/support/bar_mesh.hpp"

namespace knap {
namespace {

struct Body {
  TetMesh mesh;
  Material material;
  Topology topology = make_topology(mesh);
  std::vector<double> masses =
      lumped_masses(topology, corner_masses(topology, tet_volumes(mesh.tets, mesh.vertices), material.density));

  VibratingBody view() const { return {topology, mesh.vertices, material, masses}; }
};

// All squared frequencies of a small body, by a dense solver.
Eigen::VectorXd dense_squares(const Body& body) {
  std::vector<Vec4> x;
  for (const Vec3& v : body.mesh.vertices) x.push_back(padded(v));
  SparseMatrix lower = stiffness_pattern(body.topology);
  update_stiffness(lower, body.topology, body.mesh.vertices, body.material, x);
  Eigen::MatrixXd k = lower;
  for (Eigen::Index j = 0; j < k.cols(); ++j)
    for (Eigen::Index i = j; i < k.rows(); ++i)
      k(i, j) /= std::sqrt(body.masses[static_cast<std::size_t>(i / 3)] * body.masses[static_cast<std::size_t>(j / 3)]);
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k, Eigen::EigenvaluesOnly)
      .eigenvalues();  // reads the lower half
}

double square(const Mode& mode) { return std::pow(2.0 * std::numbers::pi * mode.frequency, 2); }

// Kuhn's cube is the same when its axes are exchanged: many pairs of modes of exactly the same frequency.
TEST(Modes, NoneIsMissedAmongEqualOnes) {
  const Body body{bar_mesh({3, 3, 3}, 1.0), make_material(1.0, 0.25, 1.0)};
  const Eigen::VectorXd expected = dense_squares(body);
  int equal = 0;
  for (const int count : {1, 2, 5, 13, 30}) {
    const auto modes = free_modes(body.view(), {.count = count});
    ASSERT_EQ(modes.size(), static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
      EXPECT_NEAR(square(modes[static_cast<std::size_t>(i)]), expected[6 + i], 1e-8 * expected[6 + i])
          << count << ' ' << i;
      equal += i > 0 && expected[6 + i] - expected[5 + i] < 1e-10 * expected[6 + i] ? 1 : 0;
    }
  }
  EXPECT_GT(equal, 5);
}

TEST(Modes, ASingleTetHasSix) {
  Body body{TetMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.1, 0.2, 1}}, {{0, 1, 2, 3}}}, make_material(1.0, 0.25, 1.0)};
  const Eigen::VectorXd expected = dense_squares(body);
  const auto modes = free_modes(body.view(), {.count = 6});
  for (int i = 0; i < 6; ++i)
    EXPECT_NEAR(square(modes[static_cast<std::size_t>(i)]), expected[6 + i], 1e-8 * expected[6 + i]);
  EXPECT_THROW(free_modes(body.view(), {.count = 7}), InputError);
  EXPECT_THROW(free_modes(body.view(), {.count = 0}), InputError);
}

// A free bar vibrates along its axis at c0/(2 L), lowered by lateral inertia (Rayleigh: 1 - (pi nu r/L)^2/2 with r the
// polar radius of gyration).
TEST(Modes, LongitudinalFrequencyOfABar) {
  const double length = 10.0, side = 1.0, nu = 0.3;
  const Body body{bar_mesh({40, 4, 4}, 0.25), make_material(4.0, nu, 1.0)};
  const auto modes = free_modes(body.view(), {.count = 12});
  double frequency = 0.0;
  for (const Mode& mode : modes) {  // the one that stretches: its ends move along the axis, against each other
    double ends = 0.0;
    for (std::size_t i = 0; i < mode.shape.size(); ++i) {
      if (body.mesh.vertices[i].x() == 0.0) ends -= mode.shape[i].x();
      if (body.mesh.vertices[i].x() == length) ends += mode.shape[i].x();
    }
    if (std::abs(ends) / 50.0 > 0.8) frequency = mode.frequency;
  }
  const double gyration2 = side * side / 6.0;
  const double expected = 2.0 / (2.0 * length) * (1.0 - 0.5 * std::pow(std::numbers::pi * nu / length, 2) * gyration2);
  EXPECT_NEAR(frequency, expected, 0.005 * expected);
}

// What a mode of a sphere about the origin is: the share of its motion along the radius, and its mean radial motion.
struct Character {
  double radial_share = 0.0;
  double breathing_share = 0.0;
};

Character character(const Mode& mode, const Body& body) {
  double all = 0.0, radial = 0.0, mean = 0.0, outward = 0.0;
  for (std::size_t i = 0; i < mode.shape.size(); ++i) {
    const double r = body.mesh.vertices[i].norm();
    const double u = r > 0.0 ? mode.shape[i].dot(body.mesh.vertices[i]) / r : 0.0;
    all += body.masses[i] * mode.shape[i].squaredNorm();
    radial += body.masses[i] * u * u;
    mean += body.masses[i] * std::abs(u);
    outward += body.masses[i] * u;
  }
  return {radial / all, std::abs(outward) / mean};
}

// physics.md section 3: eta = omega R/c_T of the free sphere.
TEST(Modes, FreeSphere) {
  struct Row {
    double nu, spheroidal, breathing;
  };
  for (const Row& row : {Row{0.25, 2.6399, 4.4400}, Row{0.30, 2.6462, 4.9955}}) {
    const double radius = 1e-3, density = 2000.0;  // the iteration must not mind units
    Body body{tetrahedralise(Sphere{2.0 * radius}, {.element_size = 0.17 * radius}),
              make_material(1e10, row.nu, density)};
    const auto modes = free_modes(body.view(), {.count = row.nu < 0.28 ? 32 : 44});
    const double per_hertz = 2.0 * std::numbers::pi * radius / s_wave_speed(body.material.small_strain(), density);
    for (std::size_t i = 0; i < 10; ++i) {
      const bool torsional = i < 5;
      const double expected = torsional ? 2.5011 : row.spheroidal;
      EXPECT_NEAR(per_hertz * modes[i].frequency, expected, 0.02 * expected) << i;
      EXPECT_EQ(character(modes[i], body).radial_share < 0.05, torsional) << i;
      EXPECT_EQ(multiplicities(modes)[i], 5) << i;
    }
    double breathing = 0.0;
    for (const Mode& mode : modes)
      if (character(mode, body).breathing_share > 0.9) breathing = per_hertz * mode.frequency;
    EXPECT_NEAR(breathing, row.breathing, 0.02 * row.breathing) << row.nu;
  }
}

}  // namespace
}  // namespace knap
