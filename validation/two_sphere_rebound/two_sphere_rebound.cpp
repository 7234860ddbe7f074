// Two equal spheres meet obliquely: by symmetry pressure and friction are not coupled, as they are on a rigid wall
// (oblique_rebound), and each rebounds from the common tangent plane as the sphere of maw_sphere.csv does, spin
// included. Both are deformable, so this is the general contact of fragments, over the whole range from sticking to
// gross sliding, R omega = 5 mu V_n.
//
// The reference holds for vanishing contacts. While two spheres are in touch their line of centres turns by V_t t_c/R,
// which takes tan^2(theta) V t_c/(2 R) of the normal velocity: 8 % at psi1 = 8 and rho v^2/E* = 1e-6 (measured: spin 9
// % too small), 3 % at 1e-7. Out of tolerance: at psi1 0.5 and 1 the spin is 10 % too large, 15 % at 1e-6. Not by the
// step, the sweeps or the mesh.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/errors.hpp"
#include "validation/problems.hpp"
#include "validation/support/checked_step.hpp"
#include "validation/support/sphere_impact.hpp"

namespace knap {
namespace {

constexpr double friction = 0.3;

struct Rebound {
  double e_t = 0.0;          ///< tangential velocity of the centre after over before [-]
  double omega = 0.0;        ///< R times the spin over mu V_n [-]
  double restitution = 0.0;  ///< normal [-]
};

// The second sphere is the first one turned about the normal, mirrored, and coming the other way.
Simulation make_pair_of_spheres(const SphereImpact& impact) {
  const TetMesh lower_contact = granule_mesh({.diameter = 2.0 * impact.radius(),
                                              .element_size = 0.7 / impact.elements * impact.radius(),
                                              .contact_element_size = impact.contact_radius() / impact.elements,
                                              .contact_extent = 2.4 * impact.contact_radius()});
  TetMesh upper_contact = lower_contact;
  const Eigen::AngleAxisd turn(0.6, Vec3::UnitZ());
  for (Vec3& x : upper_contact.vertices) {
    x = turn * x;
    x.z() = -x.z();
  }
  for (TetCorners& tet : upper_contact.tets) std::swap(tet[2], tet[3]);
  ParticleOptions first = Granule{}.particle;
  first.poisson_ratio = impact.poisson_ratio;
  first.friction = friction;
  first.velocity = impact.speed() * Vec3(impact.tangential_speed, 0.0, -1.0);
  ParticleOptions second = first;
  second.velocity = -first.velocity;
  SimulationOptions options{.particles = {first, second}, .step_safety = impact.step_safety};
  return make_simulation(options, std::vector{lower_contact, upper_contact});
}

// Of the first sphere, whose nodes come first.
Rebound rebound(double psi, double elements) {
  SphereImpact impact{.group = 1e-7, .poisson_ratio = 0.25, .elements = elements, .friction = friction};
  impact.tangential_speed = psi * friction * (2.0 - 0.25) / (2.0 * (1.0 - 0.25));
  Simulation s = make_pair_of_spheres(impact);
  const double mass = 0.5 * s.reference.start.mass;
  const double duration = hertz_impact(mass, impact.speed(), impact.reduced_modulus(), impact.radius()).duration;
  while (s.clock.time() < 1.3 * duration) checked_step(s);
  const auto count = static_cast<std::ptrdiff_t>(s.nodes.x.size() / 2);
  Vec3 centre = Vec3::Zero(), velocity = Vec3::Zero(), spin = Vec3::Zero();
  double own_mass = 0.0, inertia = 0.0;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const auto node = static_cast<std::size_t>(i);
    own_mass += s.nodes.mass[node];
    centre += s.nodes.mass[node] * xyz(s.nodes.x[node]);
    velocity += s.nodes.mass[node] * xyz(s.nodes.v[node]);
  }
  centre /= own_mass, velocity /= own_mass;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const auto node = static_cast<std::size_t>(i);
    const Vec3 arm = xyz(s.nodes.x[node]) - centre;
    spin += s.nodes.mass[node] * arm.cross(Vec3(xyz(s.nodes.v[node])));
    inertia += 2.0 / 3.0 * s.nodes.mass[node] * arm.squaredNorm();
  }
  return {.e_t = velocity.x() / (impact.speed() * impact.tangential_speed),
          .omega = spin.norm() / inertia * impact.radius() / (friction * impact.speed()),
          .restitution = velocity.z() / impact.speed()};
}

double interpolated(const CsvColumns& table, const char* column, double psi) {
  const auto &x = table.column("psi1"), &y = table.column(column);
  for (std::size_t i = 1; i < x.size(); ++i)
    if (psi <= x[i]) return y[i - 1] + (y[i] - y[i - 1]) * (psi - x[i - 1]) / (x[i] - x[i - 1]);
  throw RuntimeFailure("psi1 beyond the table");
}

}  // namespace

void show_two_sphere_rebound(Evidence& evidence) {
  const CsvColumns table = evidence.reference("../oblique_rebound/reference.csv");
  const std::vector<double> angles =
      evidence.is_short() ? std::vector{2.0} : std::vector{0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0};
  std::vector<double> e_t, omega, restitution;
  for (const double psi : angles) {
    const Rebound found = rebound(psi, evidence.is_short() ? 3.5 : 4.5);
    e_t.push_back(found.e_t);
    omega.push_back(0.2 * found.omega);
    restitution.push_back(found.restitution);
    evidence.absolute(fmt::format("psi1 {}: e_t [-]", psi), found.e_t, interpolated(table, "e_t_centre", psi), 0.03,
                      "physics.md section 3");
    evidence.relative(fmt::format("psi1 {}: R omega/(mu V_n) [-]", psi), found.omega,
                      interpolated(table, "R_omega_over_mu_Vn", psi), 0.08, "physics.md section 3");
  }
  std::vector<double> exact_omega = table.column("R_omega_over_mu_Vn");
  for (double& value : exact_omega) value *= 0.2;
  evidence.curve({{"psi1 [-]", angles},
                  {"e_t [-]", e_t},
                  {"R omega/(5 mu V_n) [-]", omega},
                  {"normal restitution [-]", restitution}});
  evidence.plot(
      {.title = "Oblique rebound of two equal spheres, nu = 0.25",
       .x_label = "psi1 [-]",
       .y_label = "e_t, spin [-]",
       .series = {{"e_t", angles, e_t, PlotSeries::Style::Points},
                  {"R omega/(5 mu V_n)", angles, omega, PlotSeries::Style::Points},
                  {"e_t, maw_sphere.csv", table.column("psi1"), table.column("e_t_centre"), PlotSeries::Style::Dashes},
                  {"R omega/(5 mu V_n), the same", table.column("psi1"), exact_omega, PlotSeries::Style::Dashes}}});
}

}  // namespace knap
