#include "analysis/sanity_card.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/hertz.hpp"

namespace knap {
namespace {

constexpr double crossings_to_watch = 50.0;  // least duration of a run, in d / c_p
constexpr double crossings_after_contact = 10.0;

HertzImpact impact_of(const SanityInput& input) {
  return {.reduced_modulus = input.young_modulus / (1.0 - std::pow(input.poisson_ratio, 2)),
          .density = input.density,
          .diameter = input.diameter,
          .speed = std::max(0.0, input.speed * std::sin(input.angle))};
}

double characteristic_length(const FractureScale& fracture, const HertzImpact& impact) {
  return impact.reduced_modulus * fracture.fracture_energy / std::pow(fracture.strength, 2);
}

FractureCard fracture_card(const SanityInput& input, const FractureScale& fracture, const HertzImpact& impact) {
  const double length = characteristic_length(fracture, impact);
  FractureCard card;
  card.characteristic_length = length;
  card.cohesive_zone = {.length = 0.88 * length, .element_size = input.element_size, .wanted = 3.0, .least = 2.0};
  card.shear_zone = {.length = length / std::pow(fracture.shear_strength_ratio, 2),
                     .element_size = input.contact_element_size,
                     .wanted = 3.0};
  card.crushed_facets = crushed_facets(input);
  card.mode_ii_ratio = mesh_mode_ii_ratio(input);
  card.crushed_zone_energy = card.mode_ii_ratio * shared_slip_factor(card.crushed_facets);
  card.final_opening = 2.0 * fracture.fracture_energy / fracture.strength;
  card.critical_speed = critical_speed(impact, fracture.strength);
  return card;
}

/// A value with the SI prefix that leaves one to three digits before the point.
std::string with_prefix(double value, std::string_view unit) {
  struct Prefix {
    double factor;
    std::string_view symbol;
  };
  constexpr std::array<Prefix, 8> prefixes{
      {{1e9, "G"}, {1e6, "M"}, {1e3, "k"}, {1.0, ""}, {1e-3, "m"}, {1e-6, "u"}, {1e-9, "n"}, {1e-12, "p"}}};
  if (value == 0.0) return fmt::format("0 {}", unit);
  const auto* prefix = std::find_if(prefixes.begin(), prefixes.end(),
                                    [&](const Prefix& p) { return std::abs(value) >= 0.9995 * p.factor; });
  if (prefix == prefixes.end()) --prefix;
  return fmt::format("{:.3g} {}{}", value / prefix->factor, prefix->symbol, unit);
}

std::string duration(double seconds) {
  if (seconds < 120.0) return fmt::format("{:.2g} s", seconds);
  if (seconds < 7200.0) return fmt::format("{:.0f} min", seconds / 60.0);
  return fmt::format("{:.1f} h", seconds / 3600.0);
}

/// The lines of the card: name and value in columns, then a remark.
struct Lines {
  std::string text;
  void add(std::string_view name, std::string_view value, std::string_view remark = "") {
    const std::string line = fmt::format("  {:<18}{:>12}  {}", name, value, remark);
    text += line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
  }
  void add(std::string_view name, const ResolvedLength& zone) {
    std::string remark = fmt::format("{:>5.1f} elements of {:<8} {:<8}", zone.elements(),
                                     with_prefix(zone.element_size, "m"), knap::name(zone.verdict()));
    if (zone.verdict() != Verdict::Ok) remark += fmt::format("(wants {:g})", zone.wanted);
    add(name, with_prefix(zone.length, "m"), remark);
  }
};

void add_particle(Lines& lines, const SanityCard& card) {
  const SanityInput& in = card.input;
  lines.add("diameter", with_prefix(in.diameter, "m"), fmt::format("{} tets", in.num_tets));
  lines.add("mass", with_prefix(1e3 * in.density * in.volume, "g"), fmt::format("{:.4g} kg/m3", in.density));
  lines.add("Young's modulus", with_prefix(in.young_modulus, "Pa"),
            fmt::format("Poisson's ratio {:g}", in.poisson_ratio));
  lines.add("normal speed", with_prefix(card.normal_speed, "m/s"),
            in.press_time > 0.0
                ? fmt::format("of a tool that presses for {} at most", with_prefix(in.press_time, "s"))
                : fmt::format("of {:.4g} m/s at {:.3g} deg from the wall", in.speed, in.angle * 180.0 / EIGEN_PI));
}

void add_fracture(Lines& lines, const SanityCard& card) {
  if (!card.fracture) return;
  const FractureScale& law = *card.input.fracture;
  lines.add(
      "strength", with_prefix(law.strength, "Pa"),
      fmt::format("fracture energy {:.3g} J/m2, shear ratio {:g}", law.fracture_energy, law.shear_strength_ratio));
  lines.add("critical speed", with_prefix(card.fracture->critical_speed, "m/s"),
            fmt::format("expected for a normal impact; this run: {:.2f} of it",
                        card.normal_speed / card.fracture->critical_speed));
  lines.add("final opening", with_prefix(card.fracture->final_opening, "m"));
  lines.add("char. length", with_prefix(card.fracture->characteristic_length, "m"));
  lines.add("cohesive zone", card.fracture->cohesive_zone);
  lines.add("shear zone", card.fracture->shear_zone);
  lines.add(
      "crushed zone", fmt::format("{:.2f} G_c", card.fracture->crushed_zone_energy),
      fmt::format("in mode II: {:.1f} facets share the slip, mode_ii_ratio {:.3g}{}", card.fracture->crushed_facets,
                  card.fracture->mode_ii_ratio, law.crushed_zone_facets > 0.0 ? " by crushed_zone_facets" : ""));
}

void add_contact(Lines& lines, const SanityCard& card) {
  if (card.normal_speed <= 0.0) return;
  lines.add("contact radius", card.contact_radius);
  const bool is_pressed = card.input.press_time > 0.0 && card.fracture;
  lines.add("peak force", with_prefix(card.peak_force, "N"),
            is_pressed ? "expected at fracture, or Hertz of the impact" : "Hertz, unbroken");
  lines.add("contact time", with_prefix(card.contact_time, "s"), "Hertz, unbroken");
}

void add_cost(Lines& lines, const SanityCard& card) {
  lines.add("P-wave speed", with_prefix(card.p_wave_speed, "m/s"),
            fmt::format("S-wave {}", with_prefix(card.s_wave_speed, "m/s")));
  lines.add("crossing time", with_prefix(card.crossing_time, "s"));
  lines.add("end time", with_prefix(card.end_time, "s"), card.input.end_time ? "" : "expected; stops by itself");
  if (!card.input.time_step) return;
  const TimeStepScale& step = *card.input.time_step;
  lines.add("time step", with_prefix(step.dt, "s"), step.limited_by.empty() ? "" : "limited by " + step.limited_by);
  lines.add("steps", fmt::format("{:.0f}", card.num_steps));
  if (card.wall_time > 0.0) lines.add("wall time", duration(card.wall_time), "expected");
}

/// The length at two digits, rounded down, as a case file has it.
std::string rounded_down(double length) {
  const double digit = std::pow(10.0, std::floor(std::log10(length)) - 1.0);
  return with_prefix(std::floor(length / digit) * digit, "m");
}

/// What `key` must be for the zone to have its elements.
std::string remedy(std::string_view key, const ResolvedLength& zone) {
  return fmt::format("set {} = \"{}\" for {:g} elements, \"{}\" for the {:g} it takes at least", key,
                     rounded_down(zone.length / zone.wanted), zone.wanted, rounded_down(zone.length / zone.least),
                     zone.least);
}

constexpr std::string_view override_hint = "or run anyway with fracture.allow_unresolved = true";

}  // namespace

std::string_view name(Verdict verdict) {
  switch (verdict) {
    case Verdict::Ok:
      return "ok";
    case Verdict::Coarse:
      return "coarse";
    case Verdict::Refused:
      return "refused";
  }
  return "";
}

Verdict ResolvedLength::verdict() const {
  if (elements() < least) return Verdict::Refused;
  return elements() < wanted ? Verdict::Coarse : Verdict::Ok;
}

SanityCard sanity_card(const SanityInput& input) {
  const double nu = input.poisson_ratio;
  const double shear_modulus = input.young_modulus / (2.0 * (1.0 + nu));
  const double p_wave_modulus = 2.0 * shear_modulus * (1.0 - nu) / (1.0 - 2.0 * nu);
  SanityCard card{.input = input};
  card.normal_speed = std::max(0.0, input.speed * std::sin(input.angle));
  card.p_wave_speed = std::sqrt(p_wave_modulus / input.density);
  card.s_wave_speed = std::sqrt(shear_modulus / input.density);
  card.crossing_time = input.diameter / card.p_wave_speed;

  const HertzImpact impact = impact_of(input);
  if (input.fracture) card.fracture = fracture_card(input, *input.fracture, impact);
  card.contact_time = contact_time(impact);
  // What goes on pressing loads the particle until it breaks, as an impact at the critical speed does.
  HertzImpact heaviest = impact;
  if (input.press_time > 0.0 && card.fracture) heaviest.speed = std::max(impact.speed, card.fracture->critical_speed);
  card.peak_force = peak_force(heaviest);
  card.contact_radius = {
      .length = contact_radius(heaviest), .element_size = input.contact_element_size, .wanted = 3.0, .least = 1.0};

  card.end_time = input.end_time.value_or(std::max(crossings_to_watch * card.crossing_time,
                                                   card.contact_time + crossings_after_contact * card.crossing_time));
  if (input.time_step) card.num_steps = std::ceil(card.end_time / input.time_step->dt);
  card.wall_time = card.num_steps * input.num_tets * input.cost_per_tet_step;
  return card;
}

double crushed_facets(const SanityInput& input) {
  HertzImpact impact = impact_of(input);
  const FractureScale& fracture = input.fracture.value();
  impact.speed = critical_speed(impact, fracture.strength);
  const double shear_zone = characteristic_length(fracture, impact) / std::pow(fracture.shear_strength_ratio, 2);
  return std::max(1.0, std::min(shear_zone, contact_radius(impact)) / input.contact_element_size);
}

double mesh_mode_ii_ratio(const SanityInput& input) {
  const FractureScale& fracture = input.fracture.value();
  if (fracture.crushed_zone_facets == 0.0) return fracture.mode_ii_ratio;
  return fracture.mode_ii_ratio * shared_slip_factor(fracture.crushed_zone_facets) /
         shared_slip_factor(crushed_facets(input));
}

double shared_slip_factor(double facets) {
  const double part = 1.0 / std::max(1.0, facets);
  return 3.0 - 3.0 * part + part * part;
}

std::string format_sanity_card(const SanityCard& card) {
  Lines lines{"Sanity card\n"};
  add_particle(lines, card);
  add_fracture(lines, card);
  add_contact(lines, card);
  add_cost(lines, card);
  return lines.text;
}

std::vector<std::string> refusals(const SanityCard& card) {
  std::vector<std::string> messages;
  if (card.fracture && card.fracture->cohesive_zone.verdict() == Verdict::Refused) {
    const ResolvedLength& zone = card.fracture->cohesive_zone;
    messages.push_back(fmt::format("the cohesive zone of {} spans {:.2g} elements of {}, fewer than {:g}: {}, {}",
                                   with_prefix(zone.length, "m"), zone.elements(), with_prefix(zone.element_size, "m"),
                                   zone.least, remedy("mesh.element_size", zone), override_hint));
  }
  const ResolvedLength& contact = card.contact_radius;
  if (card.normal_speed > 0.0 && contact.verdict() == Verdict::Refused) {
    messages.push_back(fmt::format(
        "the contact radius of {} expected at {:.3g} m/s is {:.2g} elements of {}, less than "
        "{:g}: {}, {}",
        with_prefix(contact.length, "m"), card.normal_speed, contact.elements(), with_prefix(contact.element_size, "m"),
        contact.least, remedy("mesh.contact_element_size", contact), override_hint));
  }
  return messages;
}

}  // namespace knap
