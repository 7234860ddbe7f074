#include "app/report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "io/file_output.hpp"
#include "version.hpp"

namespace knap {
namespace {

using Json = nlohmann::ordered_json;

Json vector(const Vec3& a) { return {a.x(), a.y(), a.z()}; }

Json energy(const Simulation& s) {
  const double reference = s.ledger.reference;
  Json json{{"incident", s.reference.incident_energy},
            {"reference", reference},
            {"closure_error", s.ledger.max_closure_error},
            {"closure_error_at_end", s.ledger.closure_error()}};
  for (std::size_t i = 0; i < num_energy_terms; ++i) {
    const auto term = static_cast<EnergyTerm>(i);
    json[name(term)] = s.ledger[term] / reference;
  }
  return json;
}

Json fragments(const BreakageMeasures& m) {
  return {{"count", m.count},
          {"count_above_1pct", m.count_above_1pct},
          {"count_above_0p1pct", m.count_above_0p1pct},
          {"largest_mass_fraction", m.largest_mass_fraction},
          {"second_mass_fraction", m.second_mass_fraction},
          {"unresolved_mass_fraction", m.unresolved_mass_fraction},
          {"mass_sum_fraction", m.mass_sum_fraction}};
}

Json breakage(const BreakageMeasures& m) {
  Json json{{"label", "damage"}, {"class", name(m.breakage_class)}, {"chipping_ratio", m.chipping_ratio}};
  for (const FinerFraction& finer : m.finer) {
    const std::string key = fmt::format("t{}", finer.divisor);
    json[key] = finer.resolved ? Json(finer.fraction) : Json(nullptr);
    json[key + "_resolved"] = finer.resolved;
  }
  return json;
}

Json resolved(const ResolvedLength& zone) {
  return {{"length", zone.length}, {"elements", zone.elements()}, {"verdict", name(zone.verdict())}};
}

Json sanity(const SanityCard& card) {
  Json json{{"diameter", card.input.diameter},         {"contact_element_size", card.input.contact_element_size},
            {"element_size", card.input.element_size}, {"normal_speed", card.normal_speed},
            {"p_wave_speed", card.p_wave_speed},       {"s_wave_speed", card.s_wave_speed},
            {"crossing_time", card.crossing_time},     {"hertz_contact_time", card.contact_time},
            {"hertz_peak_force", card.peak_force},     {"contact_radius", resolved(card.contact_radius)}};
  if (card.fracture) {
    json["characteristic_length"] = card.fracture->characteristic_length;
    json["cohesive_zone"] = resolved(card.fracture->cohesive_zone);
    json["shear_zone"] = resolved(card.fracture->shear_zone);
    json["crushed_zone"] = {{"facets", card.fracture->crushed_facets},
                            {"mode_ii_ratio", card.fracture->mode_ii_ratio},
                            {"energy_over_fracture_energy", card.fracture->crushed_zone_energy}};
    json["final_opening"] = card.fracture->final_opening;
    json["critical_speed"] = card.fracture->critical_speed;
  }
  json["expected_end_time"] = card.end_time;
  json["expected_steps"] = card.num_steps;
  json["expected_wall_time"] = card.wall_time;
  if (card.input.time_step) json["time_step_limited_by"] = card.input.time_step->limited_by;
  return json;
}

Json particles(const RunOutcome& outcome) {
  Json list = Json::array();
  for (const ParticleOutcome& particle : outcome.particles)
    list.push_back({{"name", particle.name},
                    {"mass", particle.mass},
                    {"largest_fragment_velocity", vector(particle.velocity)},
                    {"fragments", fragments(particle.measures)},
                    {"breakage", breakage(particle.measures)}});
  return list;
}

Json rebound(const RunOutcome& outcome) {
  const Fragment& largest = outcome.strict.fragments.front();
  return {{"restitution_normal", outcome.rebound.normal},
          {"restitution_tangential", outcome.rebound.tangential},
          {"spin", largest.spin.norm()},
          {"spin_vector", vector(largest.spin)},
          {"largest_fragment_velocity", vector(largest.velocity)}};
}

Json cracks(const Simulation& s, const CrackCensus& census) {
  return {{"area", census.area},
          {"area_mode_i", census.area_mode_i},
          {"area_mode_ii", census.area_mode_ii},
          {"failed_area", census.failed_area},
          {"inserted_facets", s.totals.inserted_facets}};
}

Json tools(const Simulation& s) {
  const auto time_of = [&](std::int64_t step) {
    return step < 0 ? Json(nullptr) : Json(s.clock.dt * static_cast<double>(step));
  };
  Json list = Json::array();
  for (std::size_t k = 0; k < s.tools.size(); ++k) {
    const ToolState& state = s.tools[k].state;
    list.push_back({{"name", s.tools[k].name},
                    {"max_force", state.max_force},
                    {"impulse", vector(state.impulse)},
                    {"moment", vector(state.moment)},
                    {"work", state.work},
                    {"friction_loss", state.friction_loss},
                    {"impact_loss", state.impact_loss},
                    {"first_contact", time_of(state.first_step)},
                    {"last_contact", time_of(state.last_step)},
                    {"displacement", vector(tool_displacement(s, k))},
                    {"velocity", vector(state.velocity)}});
  }
  return list;
}

Json quasistatic(const OnsetStart& start) {
  return {{"onset_force", start.force},
          {"approach", start.approach},
          {"strain_energy", start.strain_energy},
          {"load_steps", start.steps.size()},
          {"newton_iterations", start.newton_iterations},
          {"factorisations", start.factorisations},
          {"wall_s", start.wall_seconds}};
}

Json compression(const Compression& c) {
  return {{"tool", c.tool},          {"fracture_force", c.fracture.force}, {"displacement", c.fracture.displacement},
          {"time", c.fracture.time}, {"strength", c.fracture.strength},    {"has_dropped", c.fracture.has_dropped}};
}

Json performance(const Simulation& s, const Session& session) {
  const auto steps = static_cast<double>(s.clock.step - session.first_step);
  Json phases;
  for (std::size_t i = 0; i < num_phases; ++i) phases[name(static_cast<Phase>(i))] = s.phase_times[i];
  const double rate = session.wall_seconds > 0.0 ? steps * s.topology.num_tets() / session.wall_seconds : 0.0;
  return {{"wall_s", session.wall_seconds},
          {"tet_updates_per_s", rate},
          {"threads", session.threads},
          {"resumed_from_step", session.is_resumed ? Json(session.first_step) : Json(nullptr)},
          {"phases", phases}};
}

Json units() {
  return {{"time", "s"},
          {"mesh.edge_mean", "m"},
          {"mesh.smallest_volume_ratio", "-, of the most compressed tet at any energy balance; <= 0 = inverted"},
          {"energy.incident, energy.reference", "J; kinetic at the start; the same and what tools have put in"},
          {"energy, terms and errors", "of the reference, at the end; closure_error is the largest of the run"},
          {"momentum.linear_error", "of m v"},
          {"momentum.angular_error", "of the larger of m v R and the initial angular momentum"},
          {"fragments, breakage", "mass over the particle's mass; fragments by the strict label, breakage by damage"},
          {"particles", "kg, m/s; fragments and breakage by the damage label, over each one's own mass and size"},
          {"rebound.restitution_*", "velocity of the mass centre over its incident part"},
          {"rebound.spin", "rad/s, of the largest fragment"},
          {"rebound.largest_fragment_velocity", "m/s"},
          {"cracks.*area*", "m2"},
          {"tools.*.max_force", "N, of the normal forces of one step"},
          {"tools.*.impulse, moment", "N s, N m s, on the particle; the moment about the tool's position"},
          {"tools.*.work, *_loss", "J, done on the particle"},
          {"tools.*.displacement, velocity", "m since the start, m/s, of the tool"},
          {"compression", "N, m, s; strength = 0.9 F/d^2 in Pa; force smoothed, largest before it dropped"},
          {"sanity", "SI: m, s, m/s, N"},
          {"performance", "s of wall-clock time, of this session"}};
}

}  // namespace

void write_report(const std::filesystem::path& path, const Simulation& s, const RunOutcome& outcome) {
  Json report{{"status", status(outcome.session.stop_reason)},
              {"stop_reason", name(outcome.session.stop_reason)},
              {"version", version},
              {"case", outcome.case_name},
              {"state_hash", outcome.state_hash}};
  report["mesh"] = {
      {"tets", outcome.quality.num_tets},         {"nodes", outcome.quality.num_vertices},
      {"quality_min", outcome.quality.min_shape}, {"edge_mean", outcome.quality.mean_edge},
      {"nodes_at_end", s.nodes.size()},           {"smallest_volume_ratio", s.totals.smallest_volume_ratio}};
  report["time"] = {{"end", s.clock.time()}, {"steps", s.clock.step}, {"dt", s.clock.dt}};
  report["energy"] = energy(s);
  report["momentum"] = {{"linear_error", outcome.momentum.linear}, {"angular_error", outcome.momentum.angular}};
  report["fragments"] = fragments(outcome.strict.measures);
  report["fragments"]["label"] = "strict";
  report["fragments"]["by_damage_label"] = fragments(outcome.damage.measures);
  report["breakage"] = breakage(outcome.damage.measures);
  if (outcome.particles.size() > 1) report["particles"] = particles(outcome);
  report["rebound"] = rebound(outcome);
  report["cracks"] = cracks(s, outcome.cracks);
  report["tools"] = tools(s);
  if (outcome.onset) report["quasistatic"] = quasistatic(*outcome.onset);
  if (outcome.compression) report["compression"] = compression(*outcome.compression);
  report["mass_scaling"] = {{"added_mass_fraction", s.totals.added_mass / s.reference.start.mass}};
  report["sanity"] = sanity(outcome.card);
  report["performance"] = performance(s, outcome.session);
  report["units"] = units();
  write_text_atomically(path, report.dump(2) + "\n");
}

}  // namespace knap
