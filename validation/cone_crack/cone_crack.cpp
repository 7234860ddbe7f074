// Gamma-alumina of 1.09 mm at 23 m/s: "cone crack first, then secondary cracks and fragmentation" (Antonyuk et al.
// 2006). By the order and the place of what fails: a cone around the contact, whose facets contain the azimuth, against
// meridional planes, whose facets face it.
#include <algorithm>
#include <cmath>

#include "validation/problems.hpp"
#include "validation/support/case_run.hpp"
#include "validation/support/crack_events.hpp"

namespace knap {
namespace {

// Facets this much along the azimuth lie on meridional planes; a facet of any direction has 0.5 in the mean.
constexpr double meridional_share = 0.8, cone_share = 0.5;

struct Kind {
  std::vector<CrackEvent> events{};

  double area() const {
    double sum = 0.0;
    for (const CrackEvent& event : events) sum += event.area;
    return sum;
  }
  /// When a part of the kind's final area has failed [s].
  double time_of(double part) const {
    double sum = 0.0;
    for (const CrackEvent& event : events)
      if ((sum += event.area) >= part * area()) return event.time;
    return std::numeric_limits<double>::infinity();
  }
  /// Mean height [m] by area.
  double height() const {
    double sum = 0.0;
    for (const CrackEvent& event : events) sum += event.area * event.place.z();
    return sum / area();
  }
  PlotSeries series(const std::string& name) const {
    PlotSeries curve{.name = name};
    double sum = 0.0;
    for (const CrackEvent& event : events) {
      curve.x.push_back(1e6 * event.time);
      curve.y.push_back(1e6 * (sum += event.area));
    }
    return curve;
  }
};

// Speed [m/s] at which the top of what has failed rises, from a tenth to nine tenths of its way; top = the height below
// which 95 % of the area so far lies.
double rising_speed(const Kind& kind, double from, double to) {
  double start = 0.0, end = 0.0;
  std::vector<double> heights;
  for (const CrackEvent& event : kind.events) {
    heights.push_back(event.place.z());
    std::vector<double> sorted = heights;
    const auto top = sorted.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(sorted.size() - 1));
    std::nth_element(sorted.begin(), top, sorted.end());
    if (start == 0.0 && *top > from) start = event.time;
    if (end == 0.0 && *top > to) end = event.time;
  }
  return end > start && start > 0.0 ? (to - from) / (end - start) : 0.0;
}

}  // namespace

void show_cone_crack(Evidence& evidence) {
  std::vector<std::string> overrides{"run.threads=1"};
  if (evidence.is_short()) overrides.emplace_back("run.end_time=4us");
  const RunConfig config = shipped_case("alumina_23mps", overrides);
  CrackEvents events(16);
  const CaseRun run = run_case(config, "alumina_23mps", {.observers = {&events}});
  const double radius = 0.5 * config.particles[0].diameter;
  Kind cone, meridional;
  for (const CrackEvent& event : events.events()) {
    const bool near = event.place.norm() < 0.6 * radius;
    if (near && event.azimuthal() < cone_share) cone.events.push_back(event);
    if (!near && event.azimuthal() > meridional_share) meridional.events.push_back(event);
  }
  evidence.at_least("first meridional failure after the first of the cone [us]",
                    1e6 * (meridional.time_of(0.0) - cone.time_of(0.0)), 0.0, "cone crack first");
  evidence.at_least("half of the meridional failures after half of the cone's [us]",
                    1e6 * (meridional.time_of(0.5) - cone.time_of(0.5)), 0.0, "cone crack first");
  evidence.at_most("height of the cone's failures over the diameter [-]", 0.5 * cone.height() / radius, 0.3,
                   "under the contact");
  const double shear_speed = run.outcome.card.s_wave_speed;
  const double speed = rising_speed(meridional, 0.7 * radius, 1.2 * radius);
  evidence.between("speed of the meridional cracks upwards over c_s [-]", speed / shear_speed, 0.05, 0.93,
                   "a crack, slower than Rayleigh waves");
  evidence.tell("that speed [m/s]", speed, "the prototype had 600 to 700 m/s");
  evidence.tell("first failure of the cone [us]", 1e6 * cone.time_of(0.0), "the prototype had 0.76 us");
  if (!evidence.is_short())
    evidence.at_least("chipping ratio [-]", run.outcome.damage.measures.chipping_ratio, 0.1,
                      "fragmentation is observed");
  const PlotSeries a = cone.series("cone: within 0.6 R of the contact, across the azimuth");
  const PlotSeries b = meridional.series("meridional planes, beyond");
  evidence.curve({{"time [us]", a.x}, {"failed cone area [mm2]", a.y}}, "cone.csv");
  evidence.curve({{"time [us]", b.x}, {"failed meridional area [mm2]", b.y}});
  evidence.plot({.title = "Alumina at 23 m/s: what fails first",
                 .x_label = "time [us]",
                 .y_label = "failed area [mm2]",
                 .series = {a, b}});
}

}  // namespace knap
