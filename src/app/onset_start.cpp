#include "app/onset_start.hpp"

#include <fmt/format.h>

#include <chrono>

#include "simulation/quasistatic_start.hpp"

namespace knap {
namespace {

// The tools' velocities are constant once a run starts at its onset.
double speed_of_approach(const Simulation& s) {
  double speed = 0.0;
  for (const Tool& tool : s.tools) speed += tool.state.velocity.dot(tool.state.orientation * Vec3::UnitZ());
  return speed;
}

std::string line(const LoadStep& step) {
  return fmt::format("  approach {:8.4g} um, force {:8.4g} N, {:6.2f} % of the strength, {} + {} nodes in touch",
                     1e6 * step.approach, step.force, 100.0 * step.utilisation, step.contacts[0], step.contacts[1]);
}

}  // namespace

OnsetStart start_from_onset(Simulation& s, const QuasistaticConfig& config, RunLog& log) {
  log.info("Loading to the onset of fracture ...");
  const auto start = std::chrono::steady_clock::now();
  OnsetStart result;
  Onset onset = start_at_onset(s, {.onset_tolerance = config.onset_tolerance,
                                   .largest_approach = config.largest_approach,
                                   .progress = [&](const LoadStep& step) {
                                     result.newton_iterations += step.iterations;
                                     log.info(line(step));
                                   }});
  result.force = onset.force;
  result.approach = onset.approach;
  result.speed = speed_of_approach(s);
  result.strain_energy = onset.strain_energy;
  result.steps = std::move(onset.steps);
  result.factorisations = onset.factorisations;
  result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  log.info(fmt::format("The first facet opens at {:.4g} N, {:.4g} um of approach ({} Newton iterations, {:.1f} s)\n",
                       result.force, 1e6 * result.approach, result.newton_iterations, result.wall_seconds));
  return result;
}

}  // namespace knap
