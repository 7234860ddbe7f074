// A zeolite granule of 1.5 mm on the wall, slow to fast: what physics.md section 1 collects of observations. Low speeds
// chip it little, 30 m/s fragments it; the restitution falls; the kinetic energy left has its minimum near the onset of
// fragmentation, 16.4 m/s by Hertz's peak force and the measured fracture force.
#include <fmt/format.h>

#include <algorithm>

#include "validation/problems.hpp"
#include "validation/support/granule_study.hpp"

namespace knap {
namespace {

constexpr double onset = 16.4;  // [m/s]

GranuleCase zeolite(double speed) {
  return {.element_size = 110e-6, .contact_element_size = 72e-6, .contact_extent = 0.3e-3, .speed = speed};
}

PlotSeries series_of(const std::string& name, const std::vector<double>& x, std::vector<double> y) {
  return {.name = name, .x = x, .y = std::move(y)};
}

}  // namespace

void show_impact_speeds(Evidence& evidence) {
  const std::vector<double> speeds = evidence.is_short()
                                         ? std::vector<double>{5.0, 12.0}
                                         : std::vector<double>{5, 8, 10, 12, 14, 16, 18, 20, 22, 25, 30, 40, 60};
  GranuleStudy study(evidence.folder() / "study.csv", {"speed [m/s]"}, evidence.keeps_runs());
  std::vector<double> restitution, kinetic, chipping, largest, second;
  for (const double speed : speeds) {
    const GranuleOutcome outcome = study.at_parameters({speed}, [&] { return granule_case(zeolite(speed)); });
    restitution.push_back(outcome.restitution);
    kinetic.push_back(outcome.kinetic);
    chipping.push_back(outcome.chipping);
    largest.push_back(outcome.largest);
    second.push_back(outcome.second);
    if (speed <= 12.0)
      evidence.at_most(fmt::format("chipping ratio at {} m/s [-]", speed), outcome.chipping, 0.02,
                       "breakage is low below 15 m/s");
  }
  evidence.at_least("restitution at 5 m/s [-]", restitution.front(), 0.95, "no dissipation but cracks in the model");
  double rise = 0.0;
  for (std::size_t i = 1; i < speeds.size() && speeds[i] <= 30.0; ++i)
    rise = std::max(rise, restitution[i] - restitution[i - 1]);
  evidence.at_most("largest rise of the restitution from one speed to the next [-]", rise, 0.05,
                   "it falls, but for the scatter of one mesh");
  if (!evidence.is_short()) {
    const auto at_30 = static_cast<std::size_t>(std::find(speeds.begin(), speeds.end(), 30.0) - speeds.begin());
    evidence.at_most("largest fragment at 30 m/s [-]", largest[at_30], 0.75, "fragmentation is observed");
    const auto lowest = std::min_element(kinetic.begin(), kinetic.end());
    evidence.between("speed of the least kinetic energy left [m/s]",
                     speeds[static_cast<std::size_t>(lowest - kinetic.begin())], onset, 2.0 * onset,
                     "near the onset of fragmentation, 16.4 m/s");
    evidence.at_least("kinetic energy left at 60 m/s over the least [-]", kinetic.back() / *lowest, 1.5,
                      "a minimum, not an end");
  }
  study.tell_kept(evidence);
  evidence.curve({{"speed [m/s]", speeds},
                  {"restitution [-]", restitution},
                  {"kinetic energy left [-]", kinetic},
                  {"chipping ratio [-]", chipping},
                  {"largest fragment [-]", largest},
                  {"second fragment [-]", second}});
  evidence.plot(
      {.title = "Zeolite of 1.5 mm on the wall",
       .x_label = "speed [m/s]",
       .y_label = "share [-]",
       .series = {series_of("restitution", speeds, restitution), series_of("kinetic energy left", speeds, kinetic),
                  series_of("chipping ratio", speeds, chipping), series_of("largest fragment", speeds, largest)}});
}

}  // namespace knap
