// A sphere vibrates freely for 1e5 steps. Leapfrog keeps an energy near the true one: of one mode, kinetic plus strain
// energy at whole steps swings by (w dt)^2/4 and does not drift. The ledger takes the strain energy where the
// velocities are, which is kept exactly as long as the law is linear.
#include <cmath>
#include <numbers>
#include <random>

#include "meshing/tetrahedralise.hpp"
#include "quasistatic/modes.hpp"
#include "simulation/make_simulation.hpp"
#include "validation/problems.hpp"
#include "validation/support/checked_step.hpp"

namespace knap {
namespace {

constexpr double radius = 1e-3, modulus = 2.45e9, nu = 0.25, density = 1270.0;  // [m], [Pa], [-], [kg/m3]

/// Energies over the mean of the first, momenta over the sum of the nodes' own.
struct Record {
  std::vector<double> step{}, whole_step{}, ledger{};
  double linear = 0.0, angular = 0.0;  ///< largest change [-]
};

// At positions and velocities of the same time, half a step after the kick before.
double energy_at_whole_step(const Simulation& s) {
  double kinetic = 0.0;
  for (std::size_t i = 0; i < s.nodes.v.size(); ++i)
    kinetic += 0.125 * s.nodes.mass[i] * (s.nodes.v[i] + s.nodes.v_before[i]).squaredNorm();
  return kinetic;
}

double own_momentum(const NodalState& nodes) {
  double sum = 0.0;
  for (std::size_t i = 0; i < nodes.v.size(); ++i) sum += nodes.mass[i] * nodes.v[i].norm();
  return sum;
}

Record vibrate(Simulation& s, std::int64_t steps, std::int64_t interval) {
  Record record;
  const Momentum start = momentum(s.nodes);
  double own = 0.0;
  std::vector<Vec4> f(s.nodes.x.size());
  while (s.clock.step < steps) {
    const double strain = strain_energy(s.elastic, s.nodes.x);  // of the whole step that begins now
    const auto x_before = s.nodes.x;
    checked_step(s);
    record.step.push_back(static_cast<double>(s.clock.step));
    record.whole_step.push_back(energy_at_whole_step(s) + strain);
    for (std::int64_t i = 1; i < interval; ++i) checked_step(s);
    record.ledger.push_back(s.ledger[EnergyTerm::Kinetic] + s.ledger[EnergyTerm::Strain]);
    own = std::max(own, own_momentum(s.nodes));
    const Momentum now = momentum(s.nodes);
    record.linear = std::max(record.linear, (now.linear - start.linear).norm());
    record.angular = std::max(record.angular, (now.angular - start.angular).norm() / radius);
  }
  record.linear /= own, record.angular /= own;
  const double mean = record.ledger.front();
  for (double& e : record.whole_step) e /= mean;
  for (double& e : record.ledger) e /= mean;
  return record;
}

// Change over the whole run of the straight line through the values.
double trend(const std::vector<double>& values) {
  double mean = 0.0, moment = 0.0, square = 0.0;
  const double middle = 0.5 * static_cast<double>(values.size() - 1);
  for (const double v : values) mean += v / static_cast<double>(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double from = static_cast<double>(i) - middle;
    moment += from * (values[i] - mean), square += from * from;
  }
  return moment / square * 2.0 * middle;
}

double swing(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low;
}

}  // namespace

void show_energy_conservation(Evidence& evidence) {
  const std::int64_t steps = evidence.is_short() ? 40000 : 100000;
  const TetMesh mesh = tetrahedralise(Sphere{2.0 * radius}, {.element_size = 0.35 * radius});
  const ParticleOptions ball{.young_modulus = modulus, .poisson_ratio = nu, .density = density};
  Simulation s = make_simulation({.particles = {ball}, .ledger_interval = 23}, mesh);
  const Mode mode =
      free_modes({s.topology, mesh.vertices, make_material(modulus, nu, density), s.nodes.mass}, {.count = 30}).back();
  Simulation broad = s;
  std::mt19937_64 random{1};
  std::uniform_real_distribution<double> any{-1.0, 1.0};
  constexpr double amplitude = 0.1;  // [m/s]; strains of 1e-4: near Hooke's law, far above round-off
  for (std::size_t i = 0; i < s.nodes.v.size(); ++i) {
    s.nodes.v[i] = padded(amplitude * mode.shape[i]);
    broad.nodes.v[i] = padded(amplitude * Vec3(any(random), any(random), any(random)));
  }
  s.nodes.v_before = s.nodes.v, broad.nodes.v_before = broad.nodes.v;
  balance_from_here(s), balance_from_here(broad);
  const double angle = 2.0 * std::numbers::pi * mode.frequency * s.clock.dt, known = 0.25 * angle * angle;
  const Record one = vibrate(s, steps, 23), all = vibrate(broad, steps, 23);

  evidence.relative("one mode: swing of the energy over (w dt)^2/4 [-]", swing(one.whole_step) / known, 1.0, 0.05,
                    "samples miss the extremes, other modes come in by round-off only");
  evidence.at_most("one mode: trend of the ledger's energy over the run [-]", std::abs(trend(one.ledger)), 1e-6,
                   "symplectic");
  evidence.at_most("one mode: swing of the ledger's energy [-]", swing(one.ledger), 1e-4,
                   "exact for Hooke's law, which strains of 1e-4 leave by as much");
  evidence.at_most("all modes: swing of the ledger's energy [-]", swing(all.ledger), 1e-4, "the same");
  evidence.at_most("all modes: trend of the ledger's energy over the run [-]", std::abs(trend(all.ledger)), 1e-6,
                   "symplectic");
  for (const auto& [name, record] : {std::pair{"one mode", &one}, {"all modes", &all}}) {
    evidence.at_most(name + std::string(": change of linear momentum [-]"), record->linear, 1e-12, "round-off");
    evidence.at_most(name + std::string(": change of angular momentum [-]"), record->angular, 3e-10,
                     "round-off of the forces, 1e-16 of the modulus over strains of 1e-4, root of 1e5 times");
  }
  evidence.curve({{"step", one.step},
                  {"one mode, whole steps [-]", one.whole_step},
                  {"one mode, ledger [-]", one.ledger},
                  {"all modes, whole steps [-]", all.whole_step},
                  {"all modes, ledger [-]", all.ledger}});
  std::vector<double> deviation;
  for (const double e : one.whole_step) deviation.push_back((e - 1.0) / known);
  const std::vector<double> ends{0.0, one.step.back()};
  evidence.plot({.title = "Energy of a sphere that vibrates in one mode",
                 .x_label = "step",
                 .y_label = "energy less that of the ledger over (w dt)^2/4 [-]",
                 .series = {{"Knap, at whole steps", one.step, deviation, PlotSeries::Style::Points},
                            {"lower bound of leapfrog", ends, {0.0, 0.0}, PlotSeries::Style::Dashes},
                            {"upper bound of leapfrog", ends, {1.0, 1.0}, PlotSeries::Style::Dashes}}});
}

}  // namespace knap
