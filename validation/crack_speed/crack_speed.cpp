// A strip of height 2 H is stretched between its long edges, which are then held; a crack from one end runs along its
// middle. Far ahead w = M strain^2 H per area waits to be released, M = lambda + 2 mu; far behind nothing is left. No
// mode I crack is faster than a Rayleigh wave, however large w/G_c (Freund 1990): what w exceeds G_c goes into inertia,
// and the more there is, the sooner the crack comes near c_R. Units: E = rho = 1; l_ch = 1. Only facets in the crack's
// plane may break, as in a grooved plate.
#include <fmt/format.h>

#include <algorithm>

#include "validation/problems.hpp"
#include "validation/support/checked_step.hpp"
#include "validation/support/plate.hpp"

namespace knap {
namespace {

constexpr double poisson_ratio = 0.25, strength = 2e-3;   // [-], [E]
constexpr double half_height = 10.0, first_crack = 10.0;  // [l_ch]

// Plane strain: E' = E/(1 - nu^2), and G_c from l_ch = E' G_c/sigma_c^2 = 1.
constexpr double plane_modulus = 1.0 / (1.0 - poisson_ratio * poisson_ratio);
constexpr double fracture_energy = strength * strength / plane_modulus;

// Root of (2 - v^2/c_s^2)^2 = 4 sqrt(1 - v^2/c_s^2) sqrt(1 - v^2/c_p^2), by bisection.
double rayleigh_speed(double shear_speed, double pressure_speed) {
  const auto function = [&](double v) {
    const double s = v * v / (shear_speed * shear_speed), p = v * v / (pressure_speed * pressure_speed);
    return (2.0 - s) * (2.0 - s) - 4.0 * std::sqrt((1.0 - s) * (1.0 - p));
  };
  double low = 0.5 * shear_speed, high = shear_speed;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (function(middle) < 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double shear_speed() { return std::sqrt(0.5 / (1.0 + poisson_ratio)); }
double pressure_speed() {
  return std::sqrt((1.0 - poisson_ratio) / ((1.0 + poisson_ratio) * (1.0 - 2.0 * poisson_ratio)));
}

struct Run {
  std::vector<double> time, tip;  // [l_ch/c_0], [l_ch]
  double speed = 0.0;             // mean over the second half of the way [c_0]
  double fastest = 0.0;           // over 4 l_ch [c_0]
  double closure_error = 0.0;
};

Simulation stretched_strip(const PlateOptions& plate, double strain) {
  const TetMesh mesh = plate_mesh(plate);
  ParticleOptions particle{.young_modulus = 1.0, .poisson_ratio = poisson_ratio, .density = 1.0};
  particle.fracture = FractureOptions{.law = {.sliding_friction = 0.0}, .strength = strength};
  particle.fracture->fracture_energy = fracture_energy;
  SimulationOptions options{.particles = {particle}};
  const auto on_edges = [&](const Vec3& x) { return x.y() < 1e-9 || x.y() > 2.0 * half_height - 1e-9; };
  // Held along x too: plane strain that way keeps the strip from drawing in.
  options.prescribed = {plane_strain(mesh), {.vertices = vertices_where(mesh, on_edges)}};
  Simulation s = make_simulation(options, mesh);
  const auto middle = facets_between(s, 1, half_height);
  break_only(s, middle);
  for (Vec4& x : s.nodes.x) x.y() += strain * (x.y() - half_height);
  update_elastic_forces(s.elastic, s.nodes.x, s.nodes.f, 0.0);
  open_slit(s, middle, [](const Vec3& x) { return x.x() < first_crack; });
  return s;
}

double crack_tip(const Simulation& s) {
  double tip = 0.0;
  for (const CrackFace& face : s.cracks.faces)
    if (has_failed(s, face.facet)) tip = std::max(tip, facet_middle(s, face.facet).x());
  return tip;
}

// Strain such that the strip far ahead holds `ratio` G_c: held along x and z, sigma = M strain, M = lambda + 2 mu.
Run run_crack(const PlateOptions& plate, double ratio) {
  const double modulus = pressure_speed() * pressure_speed();
  Simulation s = stretched_strip(plate, std::sqrt(ratio * fracture_energy / (modulus * half_height)));
  const double first = first_crack + 1.0, last = plate.lengths.x() - 10.0;
  Run run;
  double tip = 0.0;
  while (tip < last && s.clock.time() < 6.0 * last) {
    checked_step(s);
    tip = std::max(tip, crack_tip(s));
    if (tip > first && (run.tip.empty() || tip > run.tip.back()))
      run.time.push_back(s.clock.time()), run.tip.push_back(tip);
  }
  const auto half = static_cast<std::size_t>(std::lower_bound(run.tip.begin(), run.tip.end(), 0.5 * (first + last)) -
                                             run.tip.begin());
  if (half + 1 < run.tip.size()) run.speed = (run.tip.back() - run.tip[half]) / (run.time.back() - run.time[half]);
  for (std::size_t i = 0, j = 0; j < run.tip.size(); ++j) {
    while (run.tip[j] - run.tip[i] > 4.0) ++i;
    if (i > 0) run.fastest = std::max(run.fastest, (run.tip[j] - run.tip[i - 1]) / (run.time[j] - run.time[i - 1]));
  }
  run.closure_error = s.ledger.max_closure_error;
  return run;
}

}  // namespace

void show_crack_speed(Evidence& evidence) {
  const double cell = evidence.is_short() ? 0.4 : 0.25;
  const double c_R = rayleigh_speed(shear_speed(), pressure_speed());
  const PlateOptions plate{.lengths = {evidence.is_short() ? 50.0 : 70.0, 2.0 * half_height, cell}, .element = cell};
  PlotSeries speeds{.name = "mean speed", .style = PlotSeries::Style::Points};
  PlotSeries fastest{.name = "fastest over 4 l_ch", .style = PlotSeries::Style::Points};
  double largest = 0.0, closure = 0.0, slower = 0.0;
  bool grows = true;
  for (const double ratio : {1.25, 1.5, 2.0, 3.0, 5.0}) {
    const Run run = run_crack(plate, ratio);
    speeds.x.push_back(ratio), speeds.y.push_back(run.speed / c_R);
    fastest.x.push_back(ratio), fastest.y.push_back(run.fastest / c_R);
    largest = std::max({largest, run.fastest / c_R, run.speed / c_R});
    grows = grows && run.speed > slower;
    slower = run.speed;
    closure = std::max(closure, run.closure_error);
    evidence.tell(fmt::format("mean speed over c_R at w/G_c = {} [-]", ratio), run.speed / c_R,
                  "depends on the way run so far; only its bound is known");
  }
  evidence.relative("c_R over c_s from its equation [-]", c_R / shear_speed(), 0.9194, 1e-4,
                    "published root at nu = 0.25 (Achenbach 1973)");
  evidence.at_most("largest speed over c_R [-]", largest, 1.0, "no energy reaches a faster mode I crack (Freund 1990)");
  evidence.at_least("speed grows with the energy: 1 = always [-]", grows ? 1.0 : 0.0, 1.0, "more is left for inertia");
  evidence.at_most("energy closure error [-]", closure, 0.01, "physics.md 3");
  evidence.curve({{"w over G_c [-]", speeds.x}, {"mean speed over c_R [-]", speeds.y}, {"fastest [-]", fastest.y}});
  evidence.plot({.title = "Speed of a mode I crack in a stretched strip",
                 .x_label = "energy available per area, over G_c [-]",
                 .y_label = "crack speed over the Rayleigh speed [-]",
                 .series = {speeds, fastest, {"Rayleigh speed", {1.0, 5.2}, {1.0, 1.0}, PlotSeries::Style::Dashes}}});
}

}  // namespace knap
