// End-notched flexure: a beam of two arms of height h, cracked along its middle from one end, bent over supports 2 L
// apart; the crack runs in mode II. G = 9 P^2 (a + 0.254 h)^2/(16 E B^2 h^3), the correction 0.42 chi h of Wang &
// Williams 1992 with chi = 0.605 for an isotropic arm of nu = 0. The crack's length comes from the compliance
//   C = (3 (a + 0.254 h)^3 + 2 L^3)/(8 E B h^3) + 0.6 L/(E B h) + C_0,
// so that the cohesive zone does not bias it (de Moura & de Morais 2008); C_0, of the supports' lines, is found while
// the crack is still as long as it was made. a > 0.7 L: the crack grows steadily. No friction; beta = 1. Only the
// beam's middle plane may break, and is cracked without damage from the start. nu = 0: E' = E. Units: E = rho = h = B
// = 1.
// G_II falls with the mesh: 1.115 G_c at 4 elements in l_ch, 1.064 at 6. It rises with crack speed and damping (1.104
// at half the duration and 2.5 times the damping), which at the crack's end is a loss beside the cohesion's.
#include "validation/problems.hpp"
#include "validation/support/checked_step.hpp"
#include "validation/support/plate.hpp"

namespace knap {
namespace {

constexpr double half_span = 7.0, overhang = 0.5, first_crack = 5.3, last_crack = 6.2;  // [h]
constexpr double strength = 1e-3, characteristic = 0.5;                                 // sigma_c/E, l_ch/h
constexpr double fracture_energy = characteristic * strength * strength;
constexpr double correction = 0.254;  // [h]

double compliance(double a) {
  const double reach = a + correction;
  return (3.0 * reach * reach * reach + 2.0 * half_span * half_span * half_span) / 8.0 + 0.6 * half_span;
}
double crack_length(double compliance) {
  return std::cbrt((8.0 * (compliance - 0.6 * half_span) - 2.0 * half_span * half_span * half_span) / 3.0) - correction;
}
double release_rate(double load, double a) { return 9.0 / 16.0 * load * load * (a + correction) * (a + correction); }
double critical_load(double a) { return std::sqrt(16.0 / 9.0 * fracture_energy) / (a + correction); }

struct Setup {
  double element = 1.0 / 12.0;  // where the crack grows [h]
  double duration = 2400.0;     // [h/c]
};

// Places along x: fine from before the crack's end to past the load, three times as coarse elsewhere.
std::vector<double> places(double element) {
  std::vector<double> x{-overhang};
  const auto add = [&](double to, double size) {
    const double from = x.back();
    const int parts = static_cast<int>(std::ceil((to - from) / size - 1e-9));
    for (int i = 1; i <= parts; ++i) x.push_back(from + (to - from) * i / parts);
  };
  add(0.0, 3.0 * element), add(first_crack - 0.5, 3.0 * element), add(first_crack, element);
  add(half_span, element), add(half_span + 0.5, element);
  add(2.0 * half_span, 3.0 * element), add(2.0 * half_span + overhang, 3.0 * element);
  return x;
}

Simulation make_beam(const Setup& setup) {
  const std::vector<double> x = places(setup.element), y = stretched(0.0, 2.0, setup.element, 1.0);
  const TetMesh mesh = graded_plate(x, y, setup.element);
  ParticleOptions particle{.young_modulus = 1.0, .poisson_ratio = 0.0, .density = 1.0};
  particle.viscous_ratio = 0.02, particle.relaxation_time = 15.0;
  particle.fracture =
      FractureOptions{.law = {.beta = 1.0, .internal_friction = 0.0, .sliding_friction = 0.0}, .strength = strength};
  particle.fracture->fracture_energy = fracture_energy;
  SimulationOptions options{.particles = {particle}, .step_safety = 0.7};
  options.prescribed = bending(mesh, {.supports = {0.0, 2.0 * half_span},
                                      .place = half_span,
                                      .top = 2.0,
                                      .way = 1.05 * (compliance(last_crack) + 4.0) * critical_load(last_crack),
                                      .duration = setup.duration});
  Simulation s = make_simulation(options, mesh);
  const std::vector<Index> middle = facets_between(s, 1, 1.0);
  break_only(s, middle);
  open_slit(
      s, middle, [](const Vec3& v) { return v.x() < first_crack; },
      [](const Vec3& v) { return v.x() < half_span + 1.0; });
  return s;
}

struct Sliding {
  std::vector<double> opening, load;   // deflection [h], P/B [E h]
  std::vector<double> crack, release;  // a [h], G/G_c [-]
  double mean_release = 0.0;           // while the crack grows to last_crack [-]
  double kinetic_share = 0.0;          // largest kinetic over strain energy then [-]
  double friction_share = 0.0;         // dissipated by anything but cohesion and damping, over cohesion [-]
  double damping_share = 0.0;          // of the viscoelastic branch, over cohesion [-]
  double closure_error = 0.0;
};

// C_0 from readings at 10-30 % of the critical load, then crack lengths and G.
void evaluate(Sliding& r) {
  double sum = 0.0, count = 0.0;
  const double critical = critical_load(first_crack);
  for (std::size_t i = 0; i < r.load.size() && r.load[i] < 0.3 * critical; ++i)
    if (r.load[i] > 0.1 * critical) sum += r.opening[i] / r.load[i] - compliance(first_crack), ++count;
  const double offset = sum / std::max(1.0, count);
  double grown = 0.0;
  for (std::size_t i = 0; i < r.load.size(); ++i) {
    if (!(r.load[i] > 0.1 * critical)) continue;
    const double a = crack_length(r.opening[i] / r.load[i] - offset);
    r.crack.push_back(a), r.release.push_back(release_rate(r.load[i], a) / fracture_energy);
    if (a > first_crack + 0.25 && a < last_crack) r.mean_release += r.release.back(), ++grown;
  }
  r.mean_release /= std::max(1.0, grown);
}

Sliding bend(const Setup& setup) {
  Simulation s = make_beam(setup);
  const double window = setup.duration / 200.0;
  Sliding result;
  double last_impulse = 0.0, last_time = 0.0, last_way = 0.0, way = 0.0;
  while (s.clock.time() < setup.duration) {
    checked_step(s);
    way -= s.prescribed[2].velocity.y() * s.clock.dt;
    if (s.clock.time() < last_time + window) continue;
    const double impulse = s.prescribed[1].state.impulse.y();
    result.load.push_back((impulse - last_impulse) / (s.clock.time() - last_time) / setup.element);
    result.opening.push_back(0.5 * (way + last_way));
    last_impulse = impulse, last_time = s.clock.time(), last_way = way;
    if (result.load.back() > 0.5 * critical_load(first_crack))
      result.kinetic_share =
          std::max(result.kinetic_share, s.ledger[EnergyTerm::Kinetic] / s.ledger[EnergyTerm::Strain]);
  }
  evaluate(result);
  result.friction_share = (s.ledger[EnergyTerm::CrackFriction] + s.ledger[EnergyTerm::ClosureImpact]) /
                          s.ledger[EnergyTerm::CohesiveDissipated];
  result.damping_share = s.ledger[EnergyTerm::Viscous] / s.ledger[EnergyTerm::CohesiveDissipated];
  result.closure_error = s.ledger.max_closure_error;
  return result;
}

}  // namespace

void show_enf(Evidence& evidence) {
  const Sliding result = bend(Setup{});
  evidence.relative("G_II/G_c while the crack grows [-]", result.mean_release, 1.0, 0.10,
                    "corrected beam theory is good to some per cent at a/h = 5-6; 6 elements in l_ch");
  evidence.at_least("largest crack length over h [-]",
                    result.crack.empty() ? 0.0 : *std::max_element(result.crack.begin(), result.crack.end()),
                    first_crack + 0.5, "it grows");
  evidence.at_most("kinetic over strain energy [-]", result.kinetic_share, 0.02, "quasi-static");
  evidence.at_most("friction and closing over cohesion [-]", result.friction_share, 0.02, "there is no friction");
  evidence.tell("damping over cohesion [-]", result.damping_share, "part of it at the crack's end: raises G");
  evidence.at_most("energy closure error [-]", result.closure_error, 0.01, "physics.md 3");
  evidence.curve({{"crack length over h [-]", result.crack}, {"G_II/G_c [-]", result.release}});
  evidence.curve({{"deflection over h [-]", result.opening}, {"P/(E B h) [-]", result.load}}, "curve_load.csv");
  evidence.plot({.title = "End-notched flexure: energy release rate in mode II",
                 .x_label = "crack length from the compliance, over the height of an arm [-]",
                 .y_label = "G_II/G_c [-]",
                 .series = {{"Knap", result.crack, result.release, PlotSeries::Style::Points},
                            {"G_c", {first_crack, last_crack}, {1.0, 1.0}, PlotSeries::Style::Dashes}}});
}

}  // namespace knap
