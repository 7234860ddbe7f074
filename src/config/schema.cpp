#include "config/schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <charconv>

#include "config/key_builder.hpp"
#include "config/schema_rows.hpp"

namespace knap {

Range range(std::string_view text, Quantity quantity) {
  const std::size_t comma = text.find(", ");
  const auto bound = [&](std::string_view end) {
    const Conversion converted = convert_to_si(end, quantity);
    assert(converted.problem.empty());
    return converted.value;
  };
  return {bound(text.substr(1, comma - 1)), bound(text.substr(comma + 2, text.size() - comma - 3)), text.front() == '(',
          text.back() == ')', std::string(text)};
}

namespace {

std::vector<Key> make_schema() {
  std::vector<Key> all;
  const auto add = [&](const char* section, std::vector<Key> keys) {
    for (Key& key : keys) {
      key.section = section;
      all.push_back(std::move(key));
    }
  };
  add("particle", particle_keys());
  add("mesh", mesh_keys());
  add("material", material_keys());
  add("fracture", fracture_keys());
  add("tool", tool_keys());
  add("impact", impact_keys());
  add("quasistatic", quasistatic_keys());
  add("contact", contact_keys());
  add("run", run_keys());
  add("output", output_keys());
  return all;
}

}  // namespace

const std::vector<Key>& schema() {
  static const std::vector<Key> keys = make_schema();
  return keys;
}

const Key* find_key(std::string_view section, std::string_view name) {
  const auto& keys = schema();
  const auto found = std::find_if(keys.begin(), keys.end(),
                                  [&](const Key& key) { return key.section == section && key.name == name; });
  return found == keys.end() ? nullptr : &*found;
}

const std::vector<Section>& sections() {
  static const std::vector<Section> all{
      {"particle", Scope::Particle, false, "Several particles are written as [[particle]], once for each."},
      {"mesh", Scope::Particle, true, "Of all particles; [particle.mesh] after a [[particle]] is of that one alone."},
      {"material", Scope::Particle, true, "Of all particles, or [particle.material] of one."},
      {"fracture", Scope::Particle, true, "Of all particles, or [particle.fracture] of one."},
      {"tool", Scope::Tool, false, "Written as [[tool]], once for each; without any, [impact] brings a wall."},
      {"impact", Scope::Case, false, ""},
      {"quasistatic", Scope::Case, false,
       "For a particle at rest between two flat tools, at rest or driven along their normals, without gravity."},
      {"contact", Scope::Case, false, "Between fragments that have come loose. Friction: fracture.sliding_friction."},
      {"run", Scope::Case, false, ""},
      {"output", Scope::Case, false, ""}};
  return all;
}

const Section* find_section(std::string_view name) {
  const auto& all = sections();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Section& section) { return section.name == name; });
  return found == all.end() ? nullptr : &*found;
}

std::size_t count(Scope scope, const RunConfig& config) {
  switch (scope) {
    case Scope::Particle:
      return config.particles.size();
    case Scope::Tool:
      return config.tools.size();
    case Scope::Case:
      break;
  }
  return 1;
}

Scope scope(const Key& key) { return find_section(key.section)->scope; }

std::vector<std::string> section_names() {
  std::vector<std::string> names;
  for (const Section& section : sections()) names.push_back(section.name);
  return names;
}

std::vector<std::string> key_names(std::string_view section) {
  std::vector<std::string> names;
  for (const Key& key : schema())
    if (key.section == section) names.push_back(key.name);
  return names;
}

bool applies(const Key& key, const RunConfig& config, std::size_t element) {
  return !key.applies.holds || key.applies.holds(config, element);
}

bool is_required(const Key& key, const RunConfig& config, std::size_t element) {
  if (!applies(key, config, element)) return false;
  return key.fallback.kind == Fallback::Kind::Required ||
         (key.fallback.kind == Fallback::Kind::RequiredWhen && key.fallback.when.holds(config, element));
}

std::string in_words(const Range& range) {
  const std::size_t comma = range.text.find(", ");
  const std::string low = range.text.substr(1, comma - 1);
  const std::string high = range.text.substr(comma + 2, range.text.size() - comma - 3);
  const std::string start = range.low_open ? fmt::format("above {} ", low) : fmt::format("from {} ", low);
  return start + (range.high_open ? "to below " : range.low_open ? "up to " : "to ") + high;
}

}  // namespace knap
