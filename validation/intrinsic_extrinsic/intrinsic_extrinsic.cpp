// The same impact with cohesive elements everywhere from the start (springs of alpha M/h up to the strength) and with
// facets that are rigid until they crack. Both have the same criterion and the same softening; the intrinsic ones
// soften the body by about 1/alpha. Unbroken they agree, and the facets that reach the strength first are about the
// same.
//
// Breaking they do not agree within the tolerance: single springs' tractions scatter more than stresses averaged over
// two tets, and a facet that has reached the strength softens at once, where a rigid one waits until the cracks around
// its nodes let them part. alpha 5, 10 and 40 and checks of every step give the same, so it is not the springs'
// compliance.
#include <fmt/format.h>

#include <cmath>

#include "tests/support/granule.hpp"
#include "validation/problems.hpp"
#include "validation/support/checked_step.hpp"

namespace knap {
namespace {

struct Impact {
  double force = 0.0;        // largest mean over 0.2 us [N]
  double restitution = 0.0;  // normal [-]
  double kinetic = 0.0;      // left, over the incident [-]
  double crack_area = 0.0;   // [m2]
  PlotSeries speed{};        // of the mass centre over time
};

Impact impact(double speed, double penalty_ratio, double element_size, bool breaks) {
  Granule granule{.element_size = std::max(0.12e-3, element_size), .contact_element_size = element_size};
  granule.particle.velocity = {0.0, 0.0, -speed};
  granule.particle.fracture = zeolite_fracture();
  granule.particle.fracture->penalty_ratio = penalty_ratio;
  if (!breaks) granule.particle.fracture->strength = 1e8, granule.particle.fracture->fracture_energy = 1e5;
  granule.options.tools = {wall(0.3)};
  Simulation s = make_granule(granule);
  Impact result;
  double impulse = 0.0, start = 0.0;
  while (s.clock.time() < 9e-6) {
    checked_step(s);
    if (s.clock.time() < start + 0.2e-6) continue;
    const double now = s.tools[0].state.impulse.z();
    result.force = std::max(result.force, std::abs(now - impulse) / (s.clock.time() - start));
    impulse = now;
    start = s.clock.time();
    result.speed.x.push_back(1e6 * start);
    result.speed.y.push_back(momentum(s.nodes).velocity().z() / speed);
  }
  balance_energies(s);
  result.restitution = momentum(s.nodes).velocity().z() / speed;
  result.kinetic = s.ledger[EnergyTerm::Kinetic] / s.ledger.reference;
  result.crack_area = s.cracks.cracked_area;
  return result;
}

}  // namespace

void show_intrinsic_extrinsic(Evidence& evidence) {
  const double size = evidence.is_short() ? 0.12e-3 : 0.09e-3;
  constexpr double alpha = 10.0, slow = 8.0, fast = 22.0;
  const Impact elastic = impact(slow, 0.0, size, false), springs = impact(slow, alpha, size, false);
  evidence.relative("largest force at 8 m/s, unbreakable, intrinsic against bonded [N]", springs.force, elastic.force,
                    0.05, "softer by about 1/alpha, half of which the force shows");
  evidence.absolute("restitution at 8 m/s, unbreakable [-]", springs.restitution, elastic.restitution, 0.01,
                    "springs store, they do not dissipate");
  std::vector<PlotSeries> series;
  for (const double speed : {slow, fast}) {
    Impact extrinsic = impact(speed, 0.0, size, true), intrinsic = impact(speed, alpha, size, true);
    evidence.absolute(fmt::format("restitution at {} m/s, intrinsic against extrinsic [-]", speed),
                      intrinsic.restitution, extrinsic.restitution, 0.1, "scatter between meshes of this size");
    evidence.absolute(fmt::format("kinetic energy left at {} m/s [-]", speed), intrinsic.kinetic, extrinsic.kinetic,
                      0.1, "likewise");
    evidence.tell(fmt::format("crack area at {} m/s, intrinsic over extrinsic [-]", speed),
                  intrinsic.crack_area / extrinsic.crack_area, "of facets that have reached the strength");
    extrinsic.speed.name = fmt::format("extrinsic, {} m/s", speed);
    intrinsic.speed.name = fmt::format("intrinsic, {} m/s", speed);
    intrinsic.speed.style = PlotSeries::Style::Dashes;
    series.push_back(extrinsic.speed);
    series.push_back(intrinsic.speed);
  }
  std::vector<Column> columns{{"time [us]", series[0].x}};
  for (const PlotSeries& curve : series) {
    columns.push_back({curve.name + " [-]", curve.y});
    columns.back().values.resize(series[0].x.size(), curve.y.back());
  }
  evidence.curve(columns);
  evidence.plot({.title = "The same impact with intrinsic and extrinsic cracks",
                 .x_label = "time [us]",
                 .y_label = "velocity of the mass centre over the speed [-]",
                 .series = series});
}

}  // namespace knap
