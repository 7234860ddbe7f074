// A sphere spinning freely. Its rim is at 1 % of the wave speed: the centrifugal stress is 1e-4 E, while a law that
// were not rotation-exact would find strains of order 1 in every turn. The virial theorem gives the mean of that stress
// exactly: integral of sigma_ij dV = integral of rho w^2 x_i x_j dV across the axis, 0 along it.
#include <cmath>
#include <numbers>

#include "meshing/tetrahedralise.hpp"
#include "simulation/make_simulation.hpp"
#include "validation/problems.hpp"
#include "validation/support/checked_step.hpp"

namespace knap {
namespace {

constexpr double radius = 1e-3, modulus = 2.45e9, density = 1270.0;  // [m], [Pa], [kg/m3]
constexpr double rim_over_wave = 0.01;

Mat3 mean_stress(Simulation& s) {
  update_stress(s.elastic, s.nodes.x);
  Mat3 sum = Mat3::Zero();
  double volume = 0.0;
  for (std::size_t t = 0; t < s.elastic.stress.size(); ++t) {
    sum += s.reference.tet_volume[t] * as_matrix(s.elastic.stress[t]);
    volume += s.reference.tet_volume[t];
  }
  return sum / volume;
}

// Largest stress over Young's modulus in the body turned by any angle, as a whole.
double stress_of_turning(Simulation& s) {
  double largest = 0.0;
  for (int i = 1; i <= 8; ++i) {
    const Mat3 turn = Eigen::AngleAxisd(0.8 * i, Vec3(0.3, -0.5, 1.0 - 0.2 * i).normalized()).toRotationMatrix();
    std::vector<Vec4> x, f(s.nodes.x.size());
    for (const Vec3& v : s.reference.vertices) x.push_back(padded(turn * v));
    update_elastic_forces(s.elastic, x, f, 0.0);
    update_stress(s.elastic, x);
    for (const TetStress& stress : s.elastic.stress) largest = std::max(largest, as_matrix(stress).norm());
  }
  update_elastic_forces(s.elastic, s.nodes.x, s.nodes.f, 0.0);
  return largest / modulus;
}

// How far the particle as a whole has turned about the axis from the start, within half a turn [rad].
double turned(const Simulation& s, const Vec3& axis) {
  double along = 0.0, across = 0.0;
  for (std::size_t i = 0; i < s.nodes.x.size(); ++i) {
    const Vec3 from = s.reference.vertices[i] - axis * axis.dot(s.reference.vertices[i]);
    along += s.nodes.mass[i] * from.dot(xyz(s.nodes.x[i]));
    across += s.nodes.mass[i] * axis.cross(from).dot(xyz(s.nodes.x[i]));
  }
  return std::atan2(across, along);
}

// What the virial theorem says of the mean stress across the axis [Pa]; masses lumped, as they are in the run.
double stress_of_virial(const Simulation& s, const Vec3& axis, double spin) {
  double across = 0.0;
  for (std::size_t i = 0; i < s.nodes.x.size(); ++i)
    across += s.nodes.mass[i] * axis.cross(s.reference.vertices[i] - s.reference.start.centre()).squaredNorm();
  return 0.5 * spin * spin * across / (s.reference.start.mass / density);
}

/// What happened, stresses over the virial's.
struct Spin {
  double across = 0.0, along = 0.0;                       ///< mean over time [-]
  double momentum_error = 0.0, drift = 0.0;               ///< largest: angular, of the centre over the radius [-]
  double lag = 0.0;                                       ///< of the angle at the end [rad]
  std::vector<double> time{}, now_across{}, now_along{};  ///< of the first tenth of a turn, time in turns [-]
};

Spin follow(Simulation& s, const Vec3& axis, double spin, int turns) {
  Spin result;
  const double expected = stress_of_virial(s, axis, spin), period = 2.0 * std::numbers::pi / spin;
  const double own = s.reference.start.angular.norm();
  double looks = 0.0;
  while (s.clock.time() < turns * period) {
    for (int i = 0; i < 7; ++i) checked_step(s);
    const Mat3 stress = mean_stress(s) / expected;
    const double along = axis.dot(stress * axis), across = 0.5 * (stress.trace() - along);
    result.along += along, result.across += across, ++looks;
    const Momentum now = momentum(s.nodes);
    result.momentum_error = std::max(result.momentum_error, (now.angular - s.reference.start.angular).norm() / own);
    result.drift = std::max(result.drift, (now.centre() - s.reference.start.centre()).norm() / radius);
    if (s.clock.time() > 0.1 * period) continue;
    result.time.push_back(s.clock.time() / period);
    result.now_across.push_back(across), result.now_along.push_back(along);
  }
  result.along /= looks, result.across /= looks;
  result.lag = std::remainder(turned(s, axis) - spin * s.clock.time(), 2.0 * std::numbers::pi);
  return result;
}

}  // namespace

void show_rigid_spin(Evidence& evidence) {
  const int turns = evidence.is_short() ? 3 : 10;
  const Vec3 axis = Vec3(1.0, 2.0, 2.0) / 3.0;
  const double spin = rim_over_wave * std::sqrt(modulus / density) / radius;  // [rad/s]
  const ParticleOptions ball{.young_modulus = modulus, .poisson_ratio = 0.25, .density = density, .spin = spin * axis};
  Simulation s =
      make_simulation({.particles = {ball}}, tetrahedralise(Sphere{2.0 * radius}, {.element_size = 0.25 * radius}));
  evidence.at_most("stress in a body that is only turned, over E [-]", stress_of_turning(s), 1e-13, "round-off");
  const Spin found = follow(s, axis, spin, turns);
  evidence.relative("mean stress across the axis over the virial's [-]", found.across, 1.0, 0.01,
                    "mean over the vibration about it, which starts at no stress");
  evidence.absolute("mean stress along the axis over that across [-]", found.along, 0.0, 0.01, "the same");
  evidence.at_most("error of angular momentum [-]", found.momentum_error, 1e-12, "round-off of all steps");
  evidence.at_most("way of the mass centre over the radius [-]", found.drift, 1e-11, "round-off of all steps");
  evidence.at_most("error of the angle over the angle turned [-]",
                   std::abs(found.lag) / (2.0 * std::numbers::pi * turns), 1e-4,
                   "the body swells by rho w^2 R^2/E = 1e-4 at most, and turns more slowly");
  evidence.tell("steps", static_cast<double>(s.clock.step), "how long the run is");
  evidence.curve(
      {{"turns [-]", found.time}, {"stress across [-]", found.now_across}, {"stress along [-]", found.now_along}});
  const std::vector<double> ends{0.0, found.time.back()};
  evidence.plot({.title = "A sphere that spins freely: mean stress in it, first tenth of a turn",
                 .x_label = "turns [-]",
                 .y_label = "mean stress over rho w^2 R^2/5 [-]",
                 .series = {{"across the axis", found.time, found.now_across},
                            {"along the axis", found.time, found.now_along},
                            {"virial, across", ends, {1.0, 1.0}, PlotSeries::Style::Dashes},
                            {"virial, along", ends, {0.0, 0.0}, PlotSeries::Style::Dashes}}});
}

}  // namespace knap
