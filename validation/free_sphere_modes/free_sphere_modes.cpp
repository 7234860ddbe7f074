// Frequencies of a free sphere, eta = omega R/c_T: by the implicit modes, and by ring-down of the explicit run. Linear
// tets with lumped masses are wrong by O((h/R)^2), of either sign.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "fem/lumped_mass.hpp"
#include "fem/tet_reference.hpp"
#include "meshing/tetrahedralise.hpp"
#include "quasistatic/modes.hpp"
#include "simulation/make_simulation.hpp"
#include "validation/problems.hpp"
#include "validation/support/checked_step.hpp"

namespace knap {
namespace {

constexpr double radius = 1e-3, modulus = 2.45e9, density = 1270.0;  // [m], [Pa], [kg/m3]

double eta_per_hertz(double nu) { return 2.0 * std::numbers::pi * radius / s_wave_speed(lame(modulus, nu), density); }

/// eta of the quintets that come first, each the mean of its five.
struct Quintets {
  double torsional = 0.0, spheroidal = 0.0;
  std::vector<Vec3> torsional_shape{}, spheroidal_shape{};
};

Quintets quintets(const TetMesh& mesh, double nu) {
  const Topology topology = make_topology(mesh);
  const Material material = make_material(modulus, nu, density);
  const auto masses = lumped_masses(topology, corner_masses(topology, tet_volumes(mesh.tets, mesh.vertices), density));
  auto modes = free_modes({topology, mesh.vertices, material, masses}, {.count = 10, .tolerance = 1e-8});
  Quintets result;
  for (Mode& mode : modes) {
    double all = 0.0, radial = 0.0;
    for (std::size_t i = 0; i < masses.size(); ++i) {
      const Vec3& x = mesh.vertices[i];
      all += masses[i] * mode.shape[i].squaredNorm();
      if (x.norm() > 0.0) radial += masses[i] * std::pow(mode.shape[i].dot(x) / x.norm(), 2);
    }
    const bool is_torsional = radial < 0.05 * all;
    (is_torsional ? result.torsional : result.spheroidal) += 0.2 * mode.frequency * eta_per_hertz(nu);
    (is_torsional ? result.torsional_shape : result.spheroidal_shape) = std::move(mode.shape);
  }
  return result;
}

// Of the radial vibration: u_r = j_1(h r), h = omega/c_L.
std::vector<Vec3> breathing_shape(const TetMesh& mesh, double nu, double eta) {
  const Lame l = lame(modulus, nu);
  const double h = eta / radius * std::sqrt(l.mu / p_wave_modulus(l));
  std::vector<Vec3> shape;
  for (const Vec3& x : mesh.vertices) {
    const double r = x.norm(), s = h * r;
    const double j1 = s > 1e-3 ? std::sin(s) / (s * s) - std::cos(s) / s : s / 3.0;
    shape.push_back(r > 0.0 ? Vec3(j1 / r * x) : Vec3::Zero());
  }
  return shape;
}

// eta of the vibration that a velocity of this shape starts: from the zeros of the velocity's part along it.
double ring_down(const TetMesh& mesh, double nu, const std::vector<Vec3>& shape, double expected) {
  const ParticleOptions ball{.young_modulus = modulus, .poisson_ratio = nu, .density = density};
  Simulation s = make_simulation({.particles = {ball}}, mesh);
  constexpr double amplitude = 1e-3;  // [m/s], strains of 1e-6
  for (std::size_t i = 0; i < shape.size(); ++i) s.nodes.v[i] = padded(amplitude * shape[i]);
  balance_from_here(s);
  const double period = 2.0 * std::numbers::pi * radius / (expected * s_wave_speed(lame(modulus, nu), density));
  double before = 1.0, first = 0.0, last = 0.0;
  int zeros = 0;
  while (s.clock.time() < 10.5 * period) {
    checked_step(s);
    double now = 0.0;
    for (std::size_t i = 0; i < shape.size(); ++i) now += s.nodes.mass[i] * shape[i].dot(xyz(s.nodes.v[i]));
    if (before > 0.0 && now <= 0.0) {  // of one sign only: what is constant in it does not matter
      last = s.clock.time() - s.clock.dt * now / (now - before);
      if (zeros++ == 0) first = last;
    }
    before = now;
  }
  return 2.0 * std::numbers::pi * (zeros - 1) / (last - first) * radius / s_wave_speed(lame(modulus, nu), density);
}

TetMesh ball(double size_over_radius) {
  return tetrahedralise(Sphere{2.0 * radius}, {.element_size = size_over_radius * radius});
}

void show_order(Evidence& evidence, double finer, double coarser, double nu, double torsional, double spheroidal) {
  const Quintets a = quintets(ball(finer), nu), b = quintets(ball(coarser), nu);
  const auto order = [&](double fine, double coarse, double exact) {
    return std::log(std::abs(coarse - exact) / std::abs(fine - exact)) / std::log(coarser / finer);
  };
  const std::string why = "linear tets: 2, less by scatter of the meshes; more where stiffness and mass errors cancel";
  evidence.at_least("order of convergence, torsional [-]", order(a.torsional, b.torsional, torsional), 1.5, why);
  evidence.at_least("order of convergence, spheroidal [-]", order(a.spheroidal, b.spheroidal, spheroidal), 1.5, why);
}

/// One kind of vibration at every nu.
struct Family {
  std::string name;
  std::vector<double> implicit{}, ring_down{};
};

Family family(const std::string& kind, const TetMesh& mesh, const CsvColumns& reference) {
  Family found{.name = kind};
  const auto &nus = reference.column("nu"), &exact = reference.column(kind);
  for (std::size_t i = 0; i < nus.size(); ++i) {
    std::vector<Vec3> shape;
    if (kind == "breathing") {
      shape = breathing_shape(mesh, nus[i], exact[i]);
    } else {
      Quintets q = quintets(mesh, nus[i]);
      found.implicit.push_back(kind == "torsional" ? q.torsional : q.spheroidal);
      shape = std::move(kind == "torsional" ? q.torsional_shape : q.spheroidal_shape);
    }
    found.ring_down.push_back(ring_down(mesh, nus[i], shape, exact[i]));
  }
  return found;
}

}  // namespace

void show_free_sphere_modes(Evidence& evidence) {
  const double size = evidence.is_short() ? 0.14 : 0.1;
  const CsvColumns reference = evidence.reference();
  const auto& nus = reference.column("nu");
  const TetMesh mesh = ball(size);
  const std::string why = fmt::format("linear tets of {} R, error (h/R)^2/4", size);
  std::vector<Column> columns{{"nu [-]", nus}};
  PlotInput plot{
      .title = "Free vibrations of a sphere", .x_label = "Poisson's ratio [-]", .y_label = "omega R/c_T [-]"};
  const auto add = [&](const std::string& name, const std::vector<double>& values, PlotSeries::Style style) {
    if (values.empty()) return;
    columns.push_back({name + " [-]", values});
    plot.series.push_back({name, nus, values, style});
  };
  for (const char* kind : {"torsional", "spheroidal", "breathing"}) {
    const auto& exact = reference.column(kind);
    const Family found = family(kind, mesh, reference);
    for (std::size_t i = 0; i < nus.size(); ++i) {
      if (!found.implicit.empty())
        evidence.relative(fmt::format("{} at nu {}, implicit [-]", kind, nus[i]), found.implicit[i], exact[i], 0.005,
                          why);
      evidence.relative(fmt::format("{} at nu {}, ring-down [-]", kind, nus[i]), found.ring_down[i], exact[i], 0.005,
                        why);
    }
    add(found.name + ", implicit", found.implicit, PlotSeries::Style::Points);
    add(found.name + ", ring-down", found.ring_down, PlotSeries::Style::Points);
    add(found.name + ", exact", exact, PlotSeries::Style::Dashes);
  }
  show_order(evidence, size, 2.0 * size, nus[2], reference.column("torsional")[2], reference.column("spheroidal")[2]);
  evidence.curve(columns);
  evidence.plot(plot);
}

}  // namespace knap
