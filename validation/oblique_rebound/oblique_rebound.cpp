// A sphere strikes a wall with friction at an angle. The reference treats normal and tangential contact apart. On a
// rigid wall they are coupled by Dundurs' beta = (1 - 2 nu)/(2 (1 - nu)): what the pressure draws inwards, friction
// holds, and where that slips little holds against sliding. At nu = 0.25 beta is 1/3, and with mu = 0.1 e_t at psi1 =
// 0.5 is 0.54 instead of 0.76, on any mesh and with any step; with mu = 1 it is 0.72. So the curve is asked at nu =
// 0.45 (beta 0.09) with mu = 0.5, from the same theory as the table, which it reproduces; at nu = 0.25 where all slides
// and the balance of momenta alone decides. rho v^2/E* is 1e-7: the lever R - delta of friction is 1 % short at 1e-6
// already. The table itself is compared with where there is no coupling: two_sphere_rebound.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "validation/problems.hpp"
#include "validation/support/checked_step.hpp"
#include "validation/support/sphere_impact.hpp"

namespace knap {
namespace {

/// What an impact leaves; velocities of the centre.
struct Rebound {
  double e_t = 0.0;          ///< tangential after over before [-]
  double omega = 0.0;        ///< R times the spin over mu V_n [-]
  double restitution = 0.0;  ///< of the normal velocity [-]
  double angle = 0.0;        ///< of the velocity from the normal [deg]
};

double tangent_over_friction(double nu, double psi1) { return psi1 * (2.0 - nu) / (2.0 * (1.0 - nu)); }

double degrees(double tangential, double normal) { return std::atan2(tangential, normal) * 180.0 / std::numbers::pi; }

// Uncoupled Hertz-Mindlin by the method of dimensionality reduction (Popov & Hess 2015, Method of Dimensionality
// Reduction in Contact Mechanics and Friction): a row of springs under the profile x^2/R, each with Coulomb friction.
// Units: R, m, V_n, E*, and mu = 1 for all tangential quantities.
Rebound uncoupled(double nu, double mu, double psi1) {
  constexpr int springs = 400, steps = 4000;
  const double stiffness_ratio = 2.0 * (1.0 - nu) / (2.0 - nu), deepest = std::pow(15.0 / 16.0, 0.4);
  const double spacing = std::sqrt(deepest) / springs, dt = 2.9433 * deepest / steps;
  std::vector<double> slip(springs, 0.0);
  const double tangent = tangent_over_friction(nu, psi1);
  double z = 0.0, v_z = 1.0, v_x = tangent, spin = 0.0;
  while (z >= 0.0) {
    double push = 0.0, drag = 0.0;
    for (int i = 0; i < springs; ++i) {
      const double x = (i + 0.5) * spacing, normal = std::max(0.0, z - x * x), most = normal / stiffness_ratio;
      double& u = slip[static_cast<std::size_t>(i)];
      u = std::clamp(u + (v_x - spin) * dt, -most, most);
      push += 2.0 * spacing * normal, drag += 2.0 * spacing * stiffness_ratio * u;
    }
    v_z -= dt * push, v_x -= dt * drag, spin += 2.5 * dt * drag;
    z += dt * v_z;
  }
  return {v_x / tangent, spin, -v_z, degrees(mu * v_x, -v_z)};
}

// Spin of the whole about y [rad/s] by its angular momentum.
double spin_about_y(const NodalState& nodes) {
  const Momentum all = momentum(nodes);
  double angular = 0.0, inertia = 0.0;
  for (std::size_t i = 0; i < nodes.x.size(); ++i) {
    const Vec3 r = xyz(nodes.x[i]) - all.centre(), v = xyz(nodes.v[i]) - all.velocity();
    angular += nodes.mass[i] * r.cross(v).y();
    inertia += nodes.mass[i] * (r.x() * r.x() + r.z() * r.z());
  }
  return angular / inertia;
}

Rebound rebound(SphereImpact impact, double psi1) {
  impact.tangential_speed = impact.friction * tangent_over_friction(impact.poisson_ratio, psi1);
  Simulation s = make_impact(impact);
  const HertzOutcome hertz =
      hertz_impact(s.reference.start.mass, impact.speed(), impact.reduced_modulus(), impact.radius());
  while (s.clock.time() < 1.1 * hertz.duration) checked_step(s);
  const Vec3 v = momentum(s.nodes).velocity();
  return {v.x() / (impact.tangential_speed * impact.speed()),
          impact.radius() * spin_about_y(s.nodes) / (impact.friction * impact.speed()), v.z() / impact.speed(),
          degrees(v.x(), v.z())};
}

constexpr double friction = 0.5;

struct Comparison {
  std::vector<double> psi{}, e_t{}, omega{}, exact_e_t{}, exact_omega{}, restitution{};
};

// What is found and expected at each angle of incidence; omega over the 5 of gross sliding.
Comparison compare(double nu, double elements, const std::vector<double>& angles, Evidence* judge) {
  Comparison all;
  for (const double psi : angles) {
    const SphereImpact impact{.group = 1e-7, .poisson_ratio = nu, .elements = elements, .friction = friction};
    const Rebound found = rebound(impact, psi), exact = uncoupled(nu, friction, psi);
    all.psi.push_back(psi);
    all.e_t.push_back(found.e_t), all.exact_e_t.push_back(exact.e_t);
    all.omega.push_back(0.2 * found.omega), all.exact_omega.push_back(0.2 * exact.omega);
    all.restitution.push_back(found.restitution);
    if (judge == nullptr) continue;
    const auto name = [&](const char* what) { return fmt::format("nu {}, psi1 {}: {}", nu, psi, what); };
    const std::string why = "physics.md section 3";
    judge->absolute(name("e_t [-]"), found.e_t, exact.e_t, 0.03, why);
    judge->relative(name("R omega/(mu V_n) [-]"), found.omega, exact.omega, 0.08, why);
    judge->absolute(name("angle of rebound from the normal [deg]"), found.angle, exact.angle, 3.0, why);
  }
  return all;
}

// That the reference is the table's theory.
void show_table(Evidence& evidence, const CsvColumns& table) {
  double worst = 0.0;
  for (std::size_t i = 0; i < table.values[0].size(); ++i) {
    const Rebound exact = uncoupled(0.25, 1.0, table.column("psi1")[i]);
    worst = std::max({worst, std::abs(exact.e_t - table.column("e_t_centre")[i]),
                      std::abs(exact.omega - table.column("R_omega_over_mu_Vn")[i])});
  }
  evidence.at_most("reference against maw_sphere.csv, nu 0.25: largest difference [-]", worst, 1e-3,
                   "four digits, and the steps of both");
}

void show_step_and_mesh(Evidence& evidence) {
  for (const auto& [elements, safety] : {std::pair{2.5, 0.8}, {3.5, 0.8}, {3.5, 0.4}}) {
    const Rebound found = rebound(
        {.group = 1e-7, .poisson_ratio = 0.45, .elements = elements, .friction = friction, .step_safety = safety}, 2.0);
    const std::string name = fmt::format("nu 0.45, psi1 2, {} elements, step safety {}: ", elements, safety);
    evidence.tell(name + "e_t [-]", found.e_t, "dependence on mesh and step");
    evidence.tell(name + "R omega/(mu V_n) [-]", found.omega, "dependence on mesh and step");
  }
}

}  // namespace

void show_oblique_rebound(Evidence& evidence) {
  const CsvColumns table = evidence.reference();
  show_table(evidence, table);
  const bool is_short = evidence.is_short();
  const std::vector<double> angles =
      is_short ? std::vector{0.5, 6.0} : std::vector{0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0};
  const Comparison weak = compare(0.45, is_short ? 3.5 : 4.5, angles, &evidence);
  std::vector<PlotSeries> series{{"e_t", weak.psi, weak.e_t, PlotSeries::Style::Points},
                                 {"R omega/(5 mu V_n)", weak.psi, weak.omega, PlotSeries::Style::Points}};
  if (!is_short) {
    compare(0.25, 3.5, {7.0}, &evidence);
    const Comparison coupled = compare(0.25, 3.5, {0.5, 2.0, 4.0}, nullptr);
    for (std::size_t i = 0; i < coupled.psi.size(); ++i)
      evidence.tell(fmt::format("nu 0.25, psi1 {}: e_t less that of the uncoupled theory [-]", coupled.psi[i]),
                    coupled.e_t[i] - coupled.exact_e_t[i], "coupling by the rigid wall, beta = 1/3");
    show_step_and_mesh(evidence);
  }
  Comparison exact;
  for (double psi = 0.25; psi <= 8.0; psi += 0.25) {
    const Rebound there = uncoupled(0.45, friction, psi);
    exact.psi.push_back(psi), exact.e_t.push_back(there.e_t), exact.omega.push_back(0.2 * there.omega);
  }
  series.push_back({"e_t, uncoupled theory", exact.psi, exact.e_t, PlotSeries::Style::Dashes});
  series.push_back({"R omega/(5 mu V_n), the same", exact.psi, exact.omega, PlotSeries::Style::Dashes});
  evidence.curve({{"psi1 [-]", weak.psi},
                  {"e_t [-]", weak.e_t},
                  {"exact e_t [-]", weak.exact_e_t},
                  {"R omega/(5 mu V_n) [-]", weak.omega},
                  {"exact R omega/(5 mu V_n) [-]", weak.exact_omega},
                  {"normal restitution [-]", weak.restitution}});
  evidence.plot({.title = "Oblique rebound of a sphere, nu = 0.45",
                 .x_label = "psi1 = 2 (1 - nu)/(2 - nu) tan(theta)/mu, theta from the normal [-]",
                 .y_label = "e_t, spin [-]",
                 .series = series});
}

}  // namespace knap
