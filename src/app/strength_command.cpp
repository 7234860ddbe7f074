// Strength over seeds: each seed is an ordinary run in a folder of its own, so a campaign that is interrupted goes on
// where it was, and every run can be looked at.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "analysis/weibull_fit.hpp"
#include "app/commands.hpp"
#include "app/run_folder.hpp"
#include "config/load_config.hpp"
#include "io/csv_line.hpp"
#include "io/csv_table.hpp"
#include "io/file_output.hpp"
#include "io/plot.hpp"

namespace knap {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct SeedResult {
  int seed = 0;
  double force = 0.0;         ///< [N]
  double displacement = 0.0;  ///< [m]
  double strength = 0.0;      ///< [Pa]
};

RunArguments run_of_seed(const StrengthArguments& arguments, const fs::path& out, int seed) {
  RunArguments run{.case_file = arguments.case_file,
                   .overrides = {"output.frames=0", "output.picture=false"},
                   .out = out / fmt::format("seed_{:04}", seed),
                   .threads = arguments.threads,
                   .quiet = true};
  run.overrides.insert(run.overrides.end(), arguments.overrides.begin(), arguments.overrides.end());
  run.overrides.push_back(fmt::format("run.seed={}", seed));
  return run;
}

void check_case(const RunConfig& one, const RunConfig& other) {
  const auto presses = [](const ToolConfig& tool) {
    return tool.motion == MotionKind::Velocity || tool.motion == MotionKind::Ramp;
  };
  if (std::none_of(one.tools.begin(), one.tools.end(), presses))
    throw InputError("strength: needs a [[tool]] that presses the particle, with motion = \"velocity\" or \"ramp\"");
  if (one.particles == other.particles)
    throw InputError(
        "strength: every seed would be the same run: leave out mesh.seed and fracture.weibull_seed, so that run.seed "
        "decides them");
}

// The report of a seed that has been run; null if it has not come to its end.
Json finished_report(const RunFolder& folder, const RunConfig& config) {
  if (!fs::exists(folder.report())) return nullptr;
  if (!fs::exists(folder.effective()) || read_text(folder.effective()) != effective_toml(config))
    throw InputError(fmt::format("{}: is of another case; give another folder with --out", folder.path.string()));
  Json report = Json::parse(read_text(folder.report()), nullptr, false);
  return !report.is_discarded() && report.value("status", "") == "finished" ? report : Json(nullptr);
}

// Runs a seed, or goes on with it; what is done already is only read.
ExitCode run_seed(RunArguments run, Json& report) {
  auto overrides = run.overrides;
  if (run.threads) overrides.push_back(fmt::format("run.threads={}", *run.threads));
  const RunConfig config = load_config(run.case_file, overrides);
  const RunFolder folder{run.out};
  report = finished_report(folder, config);
  if (!report.is_null()) return ExitCode::Ok;
  run.resume = fs::exists(folder.checkpoint());
  run.overwrite = !run.resume;
  const ExitCode code = run_command(run);
  report = Json::parse(read_text(folder.report()));
  return code;
}

void write_results(const fs::path& out, const std::vector<SeedResult>& results, const WeibullFit& fit) {
  CsvTable table = CsvTable::create(out / "strength.csv",
                                    {"seed", "force [N]", "displacement [m]", "strength [Pa]", "rank_probability [-]"});
  std::vector<double> strengths;
  for (const SeedResult& result : results) strengths.push_back(result.strength);
  const auto ranks = ranked(strengths);
  for (const SeedResult& result : results) {
    const auto rank = std::find_if(ranks.begin(), ranks.end(),
                                   [&](const RankedSample& sample) { return sample.value == result.strength; });
    table.add_row({std::int64_t{result.seed}, result.force, result.displacement, result.strength, rank->probability});
  }
  const Json json{{"seeds", results.size()},
                  {"weibull_modulus", fit.modulus},
                  {"weibull_modulus_error", fit.modulus_error},
                  {"weibull_scale", fit.scale},
                  {"median", fit.scale * std::pow(std::log(2.0), 1.0 / fit.modulus)},
                  {"units", "Pa; modulus without unit, its standard error; by maximum likelihood"}};
  write_text_atomically(out / "strength.json", json.dump(2) + "\n");
}

// Straight where the strengths are Weibull distributed: ln(-ln(1 - P)) over ln sigma.
void draw_ranks(const fs::path& png, const std::vector<SeedResult>& results, const WeibullFit& fit) {
  std::vector<double> strengths;
  for (const SeedResult& result : results) strengths.push_back(result.strength);
  PlotSeries line{.name = fmt::format("modulus {:.3g}, scale {:.3g} MPa", fit.modulus, 1e-6 * fit.scale)};
  PlotSeries points{.name = fmt::format("{} runs", results.size()), .style = PlotSeries::Style::Points};
  for (const RankedSample& sample : ranked(strengths)) {
    points.x.push_back(std::log(1e-6 * sample.value));
    points.y.push_back(std::log(-std::log1p(-sample.probability)));
    line.x.push_back(points.x.back());
    line.y.push_back(fit.modulus * std::log(sample.value / fit.scale));
  }
  draw_plot(png, {.title = "strength of the particle",
                  .x_label = "ln(strength / MPa)",
                  .y_label = "ln(-ln(1 - P))",
                  .series = {line, points}});
}

void print_results(const std::vector<SeedResult>& results, const WeibullFit& fit, const fs::path& out) {
  fmt::print("\n{:>6} {:>12} {:>18} {:>16}\n", "seed", "force [N]", "displacement [um]", "strength [MPa]");
  for (const SeedResult& r : results)
    fmt::print("{:>6} {:>12.4g} {:>18.4g} {:>16.4g}\n", r.seed, r.force, 1e6 * r.displacement, 1e-6 * r.strength);
  fmt::print("\nWeibull modulus {:.3g} +- {:.2g}, scale {:.4g} MPa, by maximum likelihood\nresults in {}\n",
             fit.modulus, fit.modulus_error, 1e-6 * fit.scale, out.string());
  std::fflush(stdout);
}

void finish(const fs::path& out, const std::vector<SeedResult>& results) {
  if (results.size() < 2)
    throw RuntimeFailure("strength: fewer than two seeds broke; nothing can be said about their scatter");
  std::vector<double> strengths;
  for (const SeedResult& result : results) strengths.push_back(result.strength);
  const WeibullFit fit = fit_weibull(strengths);
  write_results(out, results, fit);
  print_results(results, fit, out);
  try {
    if (std::isfinite(fit.modulus)) draw_ranks(out / "strength.png", results, fit);
  } catch (const RuntimeFailure& failure) {
    fmt::print(stderr, "warning: no plot: {}\n", failure.what());
  }
}

}  // namespace

ExitCode strength_command(const StrengthArguments& arguments) {
  const fs::path out =
      arguments.out.empty() ? fs::path("out") / (arguments.case_file.stem().string() + "_strength") : arguments.out;
  const auto config_of = [&](int seed) {
    return load_config(arguments.case_file, run_of_seed(arguments, out, seed).overrides);
  };
  check_case(config_of(1), config_of(2));
  std::vector<SeedResult> results;
  for (int seed = 1; seed <= arguments.seeds; ++seed) {
    Json report;
    const ExitCode code = run_seed(run_of_seed(arguments, out, seed), report);
    if (code == ExitCode::Interrupted) return code;
    const Json found = report.value("compression", Json::object());
    if (code != ExitCode::Ok || !found.value("has_dropped", false)) {
      fmt::print(stderr, "warning: seed {} is left out: {}\n", seed,
                 code == ExitCode::Ok ? "the force had not dropped at its end" : "the run failed");
      continue;
    }
    results.push_back({seed, found.at("fracture_force"), found.at("displacement"), found.at("strength")});
    fmt::print("seed {:>4} of {}: {:.4g} MPa\n", seed, arguments.seeds, 1e-6 * results.back().strength);
    std::fflush(stdout);
  }
  finish(out, results);
  return ExitCode::Ok;
}

}  // namespace knap
