// Between two impacts a piece has all the time to come to rest: its vibrations, strains and open cracks are let go, and
// what remains is its shape and its damage. So each impact is an ordinary run, of a particle that is cracked already,
// with a ledger of its own; the alternative, one run with the other pieces taken out, would mix them.
#include "app/repeated_impacts.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/run_results.hpp"
#include "core/random.hpp"
#include "io/csv_line.hpp"
#include "io/csv_table.hpp"
#include "io/file_output.hpp"
#include "io/plot.hpp"
#include "simulation/persistent_arrays.hpp"

namespace knap {
namespace {

namespace fs = std::filesystem;

/// One line of impacts.csv.
struct ImpactRow {
  int number = 0;
  std::int64_t tets = 0;
  double mass_before = 0.0, mass_after = 0.0;  ///< of the piece thrown, of the largest piece left [kg]
  double incident_energy = 0.0;                ///< [J]
  double restitution = 0.0;                    ///< normal [-]
  double dissipated = 0.0;                     ///< by cohesion [J]
  double new_cracked_area = 0.0;               ///< [m2]
  double closure_error = 0.0;                  ///< [-]
  std::int64_t steps = 0;

  double chipping_ratio() const { return 1.0 - mass_after / mass_before; }
};

ImpactRow impact_row(int number, const Simulation& s, const RunOutcome& outcome, double old_cracked_area) {
  return {.number = number,
          .tets = s.topology.num_tets(),
          .mass_before = s.reference.start.mass,
          .mass_after = outcome.damage.fragments.front().mass,
          .incident_energy = s.reference.incident_energy,
          .restitution = outcome.rebound.normal,
          .dissipated = s.ledger[EnergyTerm::CohesiveDissipated],
          .new_cracked_area = s.cracks.cracked_area - old_cracked_area,
          .closure_error = s.ledger.max_closure_error,
          .steps = s.clock.step};
}

// The whole table anew, so that a resumed run has the same one.
void write_rows(const fs::path& path, const std::vector<ImpactRow>& rows) {
  CsvTable table =
      CsvTable::create(path, {"impact", "tets", "mass_before [kg]", "mass_after [kg]", "chipping_ratio [-]",
                              "mass_left [-]", "incident_energy [J]", "normal_restitution [-]",
                              "cohesive_dissipated [J]", "new_cracked_area [m2]", "closure_error [-]", "steps"});
  for (const ImpactRow& row : rows)
    table.add_row({std::int64_t{row.number}, row.tets, row.mass_before, row.mass_after, row.chipping_ratio(),
                   row.mass_after / rows.front().mass_before, row.incident_energy, row.restitution, row.dissipated,
                   row.new_cracked_area, row.closure_error, row.steps});
}

void draw_rows(const fs::path& png, const std::vector<ImpactRow>& rows, const std::string& title) {
  PlotSeries line;
  for (const ImpactRow& row : rows) {
    if (line.x.empty()) line.x.push_back(0.0), line.y.push_back(100.0);
    line.x.push_back(row.number);
    line.y.push_back(100.0 * row.mass_after / rows.front().mass_before);
  }
  PlotSeries points{.x = line.x, .y = line.y, .style = PlotSeries::Style::Points};
  draw_plot(png, {.title = title,
                  .x_label = "number of impacts",
                  .y_label = "largest piece, % of the first mass",
                  .series = {line, points}});
}

std::string table_of(const std::vector<ImpactRow>& rows, const std::string& folder) {
  std::string text = fmt::format("{:>8} {:>12} {:>10} {:>10} {:>10} {:>12} {:>10}\n", "impact", "energy [J]",
                                 "chips [%]", "left [%]", "rebound", "cracks [mm2]", "closure [%]");
  for (const ImpactRow& row : rows)
    text += fmt::format("{:>8} {:>12.4g} {:>10.2f} {:>10.2f} {:>10.3f} {:>12.4g} {:>10.4f}\n", row.number,
                        row.incident_energy, 100.0 * row.chipping_ratio(),
                        100.0 * row.mass_after / rows.front().mass_before, row.restitution, 1e6 * row.new_cracked_area,
                        100.0 * row.closure_error);
  return text + fmt::format("results in {}\n", folder);
}

bool is_finished(const RunFolder& folder) {
  if (!fs::exists(folder.report()) || !fs::exists(folder.checkpoint())) return false;
  const auto report = nlohmann::json::parse(read_text(folder.report()), nullptr, false);
  return !report.is_discarded() && report.value("status", "") == "finished";
}

// How the piece of that impact lies.
void turn(TetMesh& mesh, const RunConfig& config, int number) {
  if (config.impact.repeat_orientation == PieceOrientation::Kept) return;
  std::uint64_t state = static_cast<std::uint64_t>(config.run.seed) ^ (static_cast<std::uint64_t>(number) << 48U);
  const Mat3 rotation = random_rotation(state);
  for (Vec3& x : mesh.vertices) x = rotation * x;
}

// The end of an impact that had ended before this session.
RunOutcome reread(PreparedRun& run, const RunFolder& folder) {
  restore_checkpoint(run.simulation, read_checkpoint(folder.checkpoint()));
  return run_outcome(run.simulation, run.identity, {});
}

RunOutcome run_impact(PreparedRun& run, SessionOptions options, RunLog& log) {
  const RunFolder& folder = options.folder;
  if (options.resume && is_finished(folder)) return reread(run, folder);
  fs::create_directories(folder.path);
  options.resume = options.resume && fs::exists(folder.checkpoint());
  options.keeps_end = true;
  return run_to_results(run, options, log);
}

// The whole run's report is that of the first impact, of a particle that was whole, and what became of it.
void write_whole_report(const RunFolder& folder, const std::vector<ImpactRow>& rows) {
  auto report = nlohmann::ordered_json::parse(read_text(folder.impact(1).report()));
  report["impacts"] = {{"count", rows.size()}, {"mass_left", rows.back().mass_after / rows.front().mass_before}};
  write_text_atomically(folder.report(), report.dump(2) + "\n");
}

void finish(const std::vector<ImpactRow>& rows, const std::string& name, const SessionOptions& options, RunLog& log) {
  write_whole_report(options.folder, rows);
  const std::string text = table_of(rows, options.folder.path.string());
  log.note(text);
  if (!options.quiet) fmt::print("\n{}: {} impacts\n{}", name, rows.size(), text);
  std::fflush(stdout);
  if (!options.output.picture) return;
  try {
    draw_rows(options.folder.impacts_plot(), rows, name);
  } catch (const RuntimeFailure& failure) {
    log.warn(fmt::format("no plot: {}", failure.what()));
  }
}

}  // namespace

ExitCode run_repeated_impacts(PreparedRun first, const RunConfig& config, const SessionOptions& options, RunLog& log) {
  PreparedRun run = std::move(first);
  const std::string name = run.identity.case_name;
  std::vector<ImpactRow> rows;
  for (int number = 1;; ++number) {
    run.identity.case_name = fmt::format("{}, impact {}", name, number);
    log.info(fmt::format("Impact {} of {}", number, config.impact.repeat));
    SessionOptions own = options;
    own.folder = options.folder.impact(number);
    const double old_cracked_area = run.simulation.cracks.cracked_area;
    const RunOutcome outcome = run_impact(run, own, log);
    if (const ExitCode code = exit_code(outcome.session.stop_reason); code != ExitCode::Ok) return code;
    rows.push_back(impact_row(number, run.simulation, outcome, old_cracked_area));
    write_rows(options.folder.impacts(), rows);
    if (number == config.impact.repeat) break;
    const Fragment& largest = outcome.damage.fragments.front();
    if (!largest.resolved()) {
      log.warn(fmt::format("the largest piece left has {} tets: too few to throw it again", largest.num_tets));
      break;
    }
    RestedPiece piece = rested_piece(run.simulation, outcome.damage.fragment_of_tet, largest.id);
    turn(piece.mesh, config, number + 1);
    run = prepare_run(std::move(piece), config, name, log);
  }
  finish(rows, name, options, log);
  return ExitCode::Ok;
}

}  // namespace knap
