// What bounces on a wall comes back as fast as it came: a sphere again and again under gravity, with flights of 2 v/g
// between, and a block that lands flat (nu = 0: plane waves), which lets go when the wave is back after 2 L/c. Gravity
// is so strong that a flight is not much longer than a contact, and weak against the forces of contact.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "tests/support/bar_mesh.hpp"
#include "validation/problems.hpp"
#include "validation/support/checked_step.hpp"
#include "validation/support/sphere_impact.hpp"

namespace knap {
namespace {

constexpr double g = 1e4;  // [m/s2]

/// One time on the wall.
struct WallContact {
  double begins = 0.0, ends = 0.0;  ///< first and last touch [s]
  double speed_before = 0.0;        ///< of the centre [m/s]
  double speed_after = 0.0;         ///< [m/s]
  double height = 0.0;              ///< of the centre when it ends [m]
};

struct Bounces {
  std::vector<WallContact> contacts{};
  std::vector<double> time{}, height{};  ///< of the centre [s], [m]
};

// Nodes of a vibrating surface come and go: a contact is over when nothing has touched for some steps.
Bounces bounce(Simulation& s, std::size_t contacts) {
  constexpr std::int64_t steps_apart = 200;
  const ToolState& wall = s.tools[0].state;
  Bounces result;
  bool is_on_wall = false;
  while (result.contacts.size() < contacts || is_on_wall) {
    const double speed_before = -momentum(s.nodes).velocity().z();
    checked_step(s);
    const Momentum now = momentum(s.nodes);
    if (!is_on_wall && wall.last_step == s.clock.step - 1) {
      result.contacts.push_back({.begins = s.clock.time(), .speed_before = speed_before});
      is_on_wall = true;
    } else if (is_on_wall && wall.last_step + steps_apart < s.clock.step) {
      const double since = static_cast<double>(s.clock.step - 1 - wall.last_step) * s.clock.dt;
      WallContact& last = result.contacts.back();
      last.ends = s.clock.time() - since;
      last.speed_after = now.velocity().z() + g * since;
      last.height = now.centre().z() - (last.speed_after - 0.5 * g * since) * since;
      is_on_wall = false;
    }
    if (s.clock.step % 50 != 0) continue;
    result.time.push_back(s.clock.time()), result.height.push_back(now.centre().z());
  }
  return result;
}

// Parabolas from where each contact ends, as fast as before it.
std::vector<double> heights_of_flight(const Bounces& bounces) {
  std::vector<double> heights;
  for (const double time : bounces.time) {
    const WallContact* last = nullptr;
    for (const WallContact& contact : bounces.contacts)
      if (contact.ends <= time) last = &contact;
    const WallContact& first = bounces.contacts.front();
    const double since = last == nullptr ? time - first.begins : time - last->ends;
    const double speed = last == nullptr ? -first.speed_before : last->speed_before;
    const double from = last == nullptr ? first.height : last->height;
    heights.push_back(std::max(from, from + speed * since - 0.5 * g * since * since));
  }
  return heights;
}

Simulation sphere_above_wall() {
  const SphereImpact impact{.group = 1e-6, .elements = 2.5};
  Granule granule{.diameter = 2.0 * impact.radius(),
                  .element_size = 0.28 * impact.radius(),
                  .contact_element_size = impact.contact_radius() / impact.elements,
                  .contact_extent = 2.4 * impact.contact_radius()};
  granule.particle.velocity = {0.0, 0.0, -impact.speed()};
  granule.options.tools = {wall()};
  granule.options.gravity = {0.0, 0.0, -g};
  granule.options.step_safety = 0.8;
  return make_granule(granule);
}

/// A block that lands flat, so many cells high.
struct Landing {
  double restitution = 0.0, duration = 0.0;  ///< [-], over 2 L/c [-]
};

Landing flat_block(Index cells) {
  const double speed = 1.0, modulus = 2.45e9, density = 1270.0, length = 1e-3;
  const ParticleOptions block{
      .young_modulus = modulus, .poisson_ratio = 0.0, .density = density, .velocity = {0.0, 0.0, -speed}};
  Simulation s = make_simulation({.particles = {block}, .tools = {wall()}}, bar_mesh({2, 2, cells}, length / cells));
  const double wave = 2.0 * length / std::sqrt(modulus / density);
  while (s.clock.time() < 2.0 * wave) checked_step(s);
  const ToolState& wall = s.tools[0].state;
  return {momentum(s.nodes).velocity().z() / speed,
          static_cast<double>(wall.last_step - wall.first_step) * s.clock.dt / wave};
}

// The front of a plane wave is as wide as the lattice spreads it, (h^2 L)^(1/3): what it leaves behind rings on. The
// nodes that land lose in proportion to h.
void show_flat_block(Evidence& evidence) {
  const Landing coarse = flat_block(20), fine = flat_block(320);
  evidence.relative("flat block of 320 cells: time on the wall over 2 L/c [-]", fine.duration, 1.0, 0.03,
                    "width of the front, (h/L)^(2/3) = 2 %");
  evidence.relative("flat block of 320 cells: speed after over before [-]", fine.restitution, 1.0, 0.02,
                    "width of the front, (h/L)^(2/3) = 2 %");
  evidence.tell("flat block of 20 cells: speed after over before [-]", coarse.restitution, "the same: 14 %");
  evidence.between("flat block: power of h in the loss of speed [-]",
                   std::log((1.0 - coarse.restitution) / (1.0 - fine.restitution)) / std::log(320.0 / 20.0), 0.6, 1.05,
                   "2/3 by the spread of the front to 1 by nodes that land");
}

}  // namespace

void show_bouncing_block(Evidence& evidence) {
  Simulation s = sphere_above_wall();
  const Bounces found = bounce(s, evidence.is_short() ? 2 : 4);
  for (std::size_t i = 0; i + 1 < found.contacts.size(); ++i) {
    const WallContact &contact = found.contacts[i], &next = found.contacts[i + 1];
    const std::string name = fmt::format("sphere, bounce {}: ", i + 1);
    evidence.relative(name + "time of flight over 2 v/g [-]",
                      (next.begins - contact.ends) * g / (2.0 * contact.speed_after), 1.0, 0.01,
                      "its surface vibrates by a thousandth of the height");
    evidence.relative(name + "speed after over before [-]", contact.speed_after / contact.speed_before, 1.0, 0.02,
                      "waves give and take 0.1 %, a coarse contact lands 1 %");
  }
  evidence.at_most("sphere: error of the energy balance [-]", s.ledger.max_closure_error, 1e-4, "method.md section 3");
  evidence.tell("sphere: energy lost to landing nodes over the incident [-]",
                s.tools[0].state.impact_loss / s.reference.incident_energy, "falls with the mesh");
  show_flat_block(evidence);
  std::vector<double> time, height, exact = heights_of_flight(found);
  for (const double t : found.time) time.push_back(1e6 * t);
  for (const double h : found.height) height.push_back(1e3 * h);
  for (double& h : exact) h *= 1e3;
  evidence.curve({{"time [us]", time}, {"height [mm]", height}, {"exact flight [mm]", exact}});
  evidence.plot({.title = "A sphere that bounces",
                 .x_label = "time [us]",
                 .y_label = "height of the centre [mm]",
                 .series = {{"Knap", time, height}, {"flights without loss", time, exact, PlotSeries::Style::Dashes}}});
}

}  // namespace knap
