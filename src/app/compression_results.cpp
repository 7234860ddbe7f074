#include "app/compression_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/csv_table.hpp"
#include "io/plot.hpp"

namespace knap {
namespace {

// The force is a mean over this many crossing times of a P-wave, about a period of the particle's lowest vibration.
constexpr double crossings_to_smooth = 4.0;
// A fall to this part of the largest force is the particle's fracture.
constexpr double drop_share = 0.5;

std::optional<Vec3> driven_velocity(const ToolMotion& motion) {
  if (const auto* constant = std::get_if<ConstantVelocity>(&motion)) return constant->velocity;
  if (const auto* ramp = std::get_if<Ramp>(&motion)) return ramp->velocity;
  return std::nullopt;
}

// The part along a direction of three columns.
std::vector<double> along(const CsvColumns& table, const std::string& stem, const char* unit, const Vec3& direction) {
  std::vector<double> sum(table.column("time [s]").size(), 0.0);
  for (const auto& [axis, part] : {std::pair{'x', direction.x()}, {'y', direction.y()}, {'z', direction.z()}}) {
    const auto& column = table.column(fmt::format("{}_{} [{}]", stem, axis, unit));
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += part * column[i];
  }
  return sum;
}

// The mean force after time 0, as if it had been the onset's before, where the particle is at rest in effect and has no
// waves to smooth.
std::vector<double> smoothed_from_onset(const ForceCurve& curve, double force, double window) {
  if (curve.time.size() < 2) return std::vector<double>(curve.time.size(), force);
  const double spacing = curve.time[1] - curve.time[0];
  const auto rows = static_cast<std::ptrdiff_t>(std::ceil(window / spacing)) + 1;
  ForceCurve longer;
  for (std::ptrdiff_t i = rows; i > 0; --i) {
    longer.time.push_back(curve.time[0] - static_cast<double>(i) * spacing);
    longer.impulse.push_back(curve.impulse[0] - static_cast<double>(i) * spacing * force);
  }
  longer.time.insert(longer.time.end(), curve.time.begin(), curve.time.end());
  longer.impulse.insert(longer.impulse.end(), curve.impulse.begin(), curve.impulse.end());
  std::vector<double> smoothed = smoothed_force(longer, window);
  smoothed.erase(smoothed.begin(), smoothed.begin() + rows);
  smoothed.front() = force;
  return smoothed;
}

// Puts the compression before time 0 in front of the curve of what came after. The tool's way and the force between
// the tools are those of the equilibria, where no waves are to be smoothed; the impulse is summed up by the trapezoidal
// rule.
void add_load_path(Compression& result, const OnsetStart& onset, double tool_speed) {
  ForceCurve& curve = result.curve;
  if (curve.time.empty()) return;
  ForceCurve path;
  std::vector<double> forces;
  std::vector<LoadStep> steps(1);  // both just touch
  steps.insert(steps.end(), onset.steps.begin(), onset.steps.end() - 1);
  for (const LoadStep& step : steps) {
    const double before = (onset.approach - step.approach) / onset.speed;
    path.time.push_back(-before);
    path.displacement.push_back(curve.displacement.front() - tool_speed * before);
    forces.push_back(step.force);
  }
  path.impulse.resize(steps.size());
  double impulse = 0.0, time = 0.0, force = onset.force;
  for (std::size_t i = steps.size(); i-- > 0;) {
    impulse -= 0.5 * (time - path.time[i]) * (force + forces[i]);
    path.impulse[i] = impulse;
    time = path.time[i];
    force = forces[i];
  }
  const auto put_before = [](std::vector<double>& column, const std::vector<double>& earlier) {
    column.insert(column.begin(), earlier.begin(), earlier.end());
  };
  put_before(curve.time, path.time);
  put_before(curve.displacement, path.displacement);
  put_before(curve.impulse, path.impulse);
  put_before(result.smoothed, forces);
}

}  // namespace

std::optional<std::size_t> pressing_tool(const Simulation& s) {
  for (std::size_t k = 0; k < s.options.tools.size(); ++k)
    if (driven_velocity(s.options.tools[k].motion)) return k;
  return std::nullopt;
}

std::optional<ForceDrop> force_drop(const RunConfig& config, const SanityCard& card, const Simulation& s) {
  constexpr double least_share = 0.1;  // of the force at which a particle of the given strength breaks
  for (std::size_t k = 0; k < config.tools.size(); ++k) {
    const double share = config.tools[k].stop_at_force_drop;
    if (share == 0.0 || !card.fracture) continue;
    const double diameter = card.input.diameter;
    const double expected = card.input.fracture->strength * diameter * diameter / 0.9;  // Hiramatsu & Oka 1966
    return ForceDrop{
        .tool = k + (has_wall(config) ? 1 : 0),
        .share = share,
        .least = least_share * expected,
        .window = std::max<std::int64_t>(1, std::llround(crossings_to_smooth * card.crossing_time / s.clock.dt))};
  }
  return std::nullopt;
}

std::optional<Compression> compression(const Simulation& s, const RunIdentity& identity,
                                       const std::filesystem::path& history) {
  const auto tool = pressing_tool(s);
  if (!tool) return std::nullopt;
  const ToolOptions& options = s.options.tools[*tool];
  const Vec3 direction = driven_velocity(options.motion)->normalized();
  const CsvColumns table = read_csv(history);
  Compression result{.tool = options.name,
                     .curve = {.time = table.column("time [s]"),
                               .displacement = along(table, options.name + "_displacement", "m", direction),
                               .impulse = along(table, options.name + "_impulse", "N s", direction)}};
  const double window = crossings_to_smooth * identity.card.crossing_time;
  if (identity.onset) {
    result.smoothed = smoothed_from_onset(result.curve, identity.onset->force, window);
    add_load_path(result, *identity.onset, driven_velocity(options.motion)->norm());
  } else {
    result.smoothed = smoothed_force(result.curve, window);
  }
  result.fracture = fracture_force(result.curve, result.smoothed, drop_share, identity.card.input.diameter);
  return result;
}

void write_force_displacement(const std::filesystem::path& path, const Compression& result) {
  CsvTable table = CsvTable::create(path, {"time [s]", "displacement [m]", "force [N]", "impulse [N s]"});
  for (std::size_t i = 0; i < result.curve.time.size(); ++i)
    table.add_row({result.curve.time[i], result.curve.displacement[i], result.smoothed[i], result.curve.impulse[i]});
}

void draw_force_displacement(const std::filesystem::path& png, const Compression& result, const std::string& title) {
  PlotSeries curve{.name = "force on " + result.tool, .y = result.smoothed};
  for (const double way : result.curve.displacement) curve.x.push_back(1e6 * way);
  const PlotSeries fracture{
      .name = fmt::format("fracture: {:.3g} N, {:.3g} MPa", result.fracture.force, 1e-6 * result.fracture.strength),
      .x = {1e6 * result.fracture.displacement},
      .y = {result.fracture.force},
      .style = PlotSeries::Style::Points};
  draw_plot(png, {.title = title,
                  .x_label = fmt::format("displacement of {} [\u00b5m]", result.tool),
                  .y_label = "force [N]",
                  .series = {curve, fracture}});
}

}  // namespace knap
