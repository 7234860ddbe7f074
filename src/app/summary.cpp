#include "app/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace knap {
namespace {

constexpr int bar_width = 30;

void add_line(std::string& text, std::string_view label, const std::string& value) {
  text += fmt::format("  {:<18}{}\n", label, value);
}

std::string bar(double share, bool utf8) {
  if (!std::isfinite(share)) return "";
  const double filled = std::clamp(share, 0.0, 1.0) * bar_width;
  if (!utf8) return std::string(static_cast<std::size_t>(std::lround(filled)), '#');
  static constexpr std::array<const char*, 8> parts{"", "▏", "▎", "▍", "▌", "▋", "▊", "▉"};
  const auto eighths = static_cast<std::size_t>(std::lround(8.0 * filled));
  std::string text;
  for (std::size_t i = 0; i < eighths / 8; ++i) text += "█";
  return text + parts[eighths % 8];
}

std::string plain(std::string_view term) {
  std::string text(term);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

void add_energies(std::string& text, const Simulation& s, bool utf8) {
  const double incident = s.ledger.reference;
  const bool is_incident = incident == s.reference.incident_energy;
  text += fmt::format("  energy at the end, of {:.4g} mJ {}\n", 1e3 * incident,
                      starts_at_onset(s) ? "stored at the start and by tools"
                      : is_incident      ? "incident"
                                         : "incident and by tools");
  for (std::size_t i = 0; i < num_energy_terms; ++i) {
    const double share = s.ledger.value[i] / incident;
    if (std::abs(share) < 5e-5) continue;
    const std::string drawn = bar(share, utf8);
    text += fmt::format("    {:<20}{:>7.2f} %{}{}\n", plain(name(static_cast<EnergyTerm>(i))), 100.0 * share,
                        drawn.empty() ? "" : "  ", drawn);
  }
}

std::string pieces_line(const BreakageMeasures& m) {
  return fmt::format("{} above 1 % of the mass, {} above 0.1 %, {} in all", m.count_above_1pct, m.count_above_0p1pct,
                     m.count);
}

void add_pieces(std::string& text, const RunOutcome& outcome) {
  const BreakageMeasures& m = outcome.damage.measures;
  if (m.count == 1) return add_line(text, "particle", "whole, in one piece");
  add_line(text, "pieces", pieces_line(m));
  add_line(text, "by strict label", pieces_line(outcome.strict.measures));
  add_line(text, "largest piece",
           fmt::format("{:.2f} % of the mass, second {:.2f} %", 100.0 * m.largest_mass_fraction,
                       100.0 * m.second_mass_fraction));
  add_line(text, "chipping ratio",
           fmt::format("{:.2f} %, of it unresolved fines {:.2f} %", 100.0 * m.chipping_ratio,
                       100.0 * m.unresolved_mass_fraction));
}

void add_cracks(std::string& text, const CrackCensus& c) {
  if (c.area <= 0.0) return;
  add_line(text, "cracks",
           fmt::format("{:.4g} mm2, {:.0f} % of it by shear, {:.4g} mm2 failed", 1e6 * c.area,
                       100.0 * c.area_mode_ii / c.area, 1e6 * c.failed_area));
}

std::string rebound_line(const RunOutcome& outcome) {
  std::string line = fmt::format("{:.3f} of the normal speed", outcome.rebound.normal);
  if (std::isfinite(outcome.rebound.tangential))
    line += fmt::format(", {:.3f} of the tangential, spin {:.4g} rad/s", outcome.rebound.tangential,
                        outcome.strict.fragments.front().spin.norm());
  return line;
}

std::string strength_line(const Compression& c) {
  return fmt::format("{:.4g} MPa, {:.4g} N by {} after {:.4g} um{}", 1e-6 * c.fracture.strength, c.fracture.force,
                     c.tool, 1e6 * c.fracture.displacement,
                     c.fracture.has_dropped ? "" : "; the force has not dropped yet");
}

std::string onset_line(const OnsetStart& onset) {
  return fmt::format("at {:.4g} N and {:.4g} um, where the run started; {} load steps in {:.1f} s", onset.force,
                     1e6 * onset.approach, onset.steps.size(), onset.wall_seconds);
}

}  // namespace

std::string summary(const Simulation& s, const RunOutcome& outcome, const std::string& folder, bool utf8) {
  const Session& session = outcome.session;
  std::string text =
      fmt::format("{}: {}, stopped at {:.4g} us ({})\n", outcome.case_name,
                  name(outcome.damage.measures.breakage_class), 1e6 * s.clock.time(), name(session.stop_reason));
  add_pieces(text, outcome);
  if (outcome.particles.size() > 1)
    for (const ParticleOutcome& particle : outcome.particles)
      add_line(text, particle.name,
               fmt::format("{}, largest piece {:.2f} % of it, chipping ratio {:.2f} %",
                           name(particle.measures.breakage_class), 100.0 * particle.measures.largest_mass_fraction,
                           100.0 * particle.measures.chipping_ratio));
  add_cracks(text, outcome.cracks);
  if (std::isfinite(outcome.rebound.normal) && s.options.particles.size() == 1)
    add_line(text, "rebound", rebound_line(outcome));
  for (const Tool& tool : s.tools)
    add_line(text, tool.name + " force", fmt::format("{:.4g} N at most", tool.state.max_force));
  if (outcome.onset) add_line(text, "first crack", onset_line(*outcome.onset));
  if (outcome.compression) add_line(text, "strength", strength_line(*outcome.compression));
  add_energies(text, s, utf8);
  add_line(text, "closure error", fmt::format("{:.4f} % at most", 100.0 * s.ledger.max_closure_error));
  if (s.totals.smallest_volume_ratio <= 0.0) add_line(text, "inverted", "a tet was turned inside out");
  const auto steps = static_cast<double>(s.clock.step - session.first_step);
  add_line(text, "effort",
           fmt::format("{:.0f} steps of {:.3g} ns in {:.1f} s on {} thread{}, {:.1f} M tet updates/s", steps,
                       1e9 * s.clock.dt, session.wall_seconds, session.threads, session.threads == 1 ? "" : "s",
                       1e-6 * steps * s.topology.num_tets() / std::max(1e-9, session.wall_seconds)));
  add_line(text, "results", folder);
  return text;
}

}  // namespace knap
