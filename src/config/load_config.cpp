#include "config/load_config.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <fstream>
#include <optional>

#include "config/contradictions.hpp"
#include "config/derived_values.hpp"
#include "config/given_keys.hpp"
#include "config/material_presets.hpp"
#include "config/toml_guard.hpp"
#include "core/errors.hpp"

namespace knap {
namespace {

namespace fs = std::filesystem;
using Problems = std::vector<std::string>;

Value trusted_value(const Key& key, const std::string& text) {
  ReadValue read = read_value(key, parse_loose_value(text), {});
  assert(read.problem.empty());
  return std::move(read.value);
}

std::size_t row(const char* section, const char* key) { return row_of(*find_key(section, key)); }

bool is_fracture_energy(const Key& key) { return key.name == "fracture_energy" || key.name == "toughness"; }

bool has_fracture_energy(const KeyLayer& layer) {
  return layer[row("fracture", "fracture_energy")] || layer[row("fracture", "toughness")];
}

// Of the two names of one quantity the command line's wins over the file's; two from one source contradict.
void settle_fracture_energy(KeyLayer& given, Problems& problems) {
  auto& energy = given[row("fracture", "fracture_energy")];
  auto& toughness = given[row("fracture", "toughness")];
  if (!energy || !toughness) return;
  if (energy->from_command_line == toughness->from_command_line) {
    problems.push_back(fmt::format("{}: fracture.toughness: give either toughness or fracture_energy (given at {})",
                                   toughness->place, energy->place));
  }
  (energy->from_command_line ? toughness : energy).reset();
}

// Fills what a layer leaves open, of [mesh], [material] and [fracture] only. Toughness and energy are one quantity.
template <class Value>
void fill(KeyLayer& layer, const Key& key, Value&& value, bool had_energy) {
  if (!layer[row_of(key)] && !(had_energy && is_fracture_energy(key))) layer[row_of(key)] = value;
}

void add_preset_values(KeyLayer& layer) {
  const auto& chosen = layer[row("material", "preset")];
  if (!chosen) return;
  const bool had_energy = has_fracture_energy(layer);
  for (const PresetValue& value : find_preset(std::get<std::string>(chosen->value))->values) {
    const Key& key = *find_key(value.section, value.key);
    fill(layer, key, Given{trusted_value(key, value.text), "", false}, had_energy);
  }
}

// What `common` says of all particles; with `from_command_line_only` only what was said there.
void add_common_values(KeyLayer& layer, const KeyLayer& common, bool from_command_line_only) {
  const bool had_energy = has_fracture_energy(layer);
  for (const Key& key : schema()) {
    const auto& value = common[row_of(key)];
    if (!value || !find_section(key.section)->is_part) continue;
    if (!from_command_line_only || value->from_command_line) fill(layer, key, *value, had_energy);
  }
}

// The command line wins over the file, also where it speaks of all particles and the file of one.
void drop_overridden(KeyLayer& layer, const KeyLayer& common) {
  const auto is_overridden = [&](const Key& key) {
    const auto& value = common[row_of(key)];
    return value && value->from_command_line;
  };
  const bool energy_is =
      is_overridden(*find_key("fracture", "fracture_energy")) || is_overridden(*find_key("fracture", "toughness"));
  for (const Key& key : schema()) {
    auto& own = layer[row_of(key)];
    if (!own || own->from_command_line || !find_section(key.section)->is_part) continue;
    if (is_overridden(key) || (energy_is && is_fracture_energy(key))) own.reset();
  }
}

// Makes each particle's layer complete: its own values, its own preset's, the common ones, the common preset's.
void settle_particles(GivenKeys& given, Problems& problems) {
  settle_fracture_energy(given.common, problems);
  for (KeyLayer& own : given.particles) {
    settle_fracture_energy(own, problems);
    drop_overridden(own, given.common);
    const bool has_own_preset = own[row("material", "preset")].has_value();
    if (has_own_preset) {
      add_common_values(own, given.common, true);
      add_preset_values(own);
    }
    add_common_values(own, given.common, false);
    if (!has_own_preset) add_preset_values(own);
  }
}

const KeyLayer& layer(const GivenKeys& given, const Key& key, std::size_t element) {
  switch (scope(key)) {
    case Scope::Particle:
      return given.particles[element];
    case Scope::Tool:
      return given.tools[element];
    case Scope::Case:
      break;
  }
  return given.common;
}

RunConfig configured(const GivenKeys& given) {
  RunConfig config;
  config.particles.resize(given.particles.size());
  config.tools.resize(given.tools.size());
  for (const Key& key : schema())
    for (std::size_t element = 0; element < count(scope(key), config); ++element) {
      const auto& own = layer(given, key, element)[row_of(key)];
      if (own) {
        key.set(config, element, own->value);
      } else if (key.fallback.kind == Fallback::Kind::Text) {
        key.set(config, element, trusted_value(key, key.fallback.text));
      }
    }
  return config;
}

std::string example(const Key& key) {
  if (key.name == "strength") return "\"8 MPa\"";
  const std::string one = fmt::format("\"{}\"", sample_value(key.quantity));
  return key.type == KeyType::Vector ? fmt::format("[{0}, {0}, {0}]", one) : one;
}

bool is_in_presets(const Key& key) {
  constexpr std::array names{"young_modulus", "poisson_ratio", "density", "strength", "fracture_energy"};
  return std::find(names.begin(), names.end(), key.name) != names.end();
}

// Where the section of a key begins for that element, else the file.
std::string header_place(const Key& key, std::size_t element, const CaseDocument& document) {
  const auto find = [&](const TableName& name) { return document.tables.find(name); };
  const Section& section = *find_section(key.section);
  const int number = static_cast<int>(element);
  const std::array<TableName, 4> names =
      section.is_part
          ? std::array<TableName, 4>{TableName{"particle", key.section, number}, TableName{"particle", key.section},
                                     TableName{key.section}, TableName{"particle", "", number}}
          : std::array<TableName, 4>{TableName{key.section, "", number}, TableName{key.section}, {}, {}};
  for (const TableName& name : names)
    if (const auto found = find(name); found != document.tables.end()) return found->second;
  return document.file;
}

std::string missing(const Key& key, std::size_t element, const CaseDocument& document) {
  std::string text = fmt::format("{}: {} is missing: {}", header_place(key, element, document), full_name(key, false),
                                 key.description);
  if (!key.range.text.empty() && key.quantity != Quantity::Ratio)
    text += fmt::format(" For instance {} = {}.", key.name, example(key));
  if (is_in_presets(key)) text += " A material.preset gives it too.";
  if (key.fallback.kind == Fallback::Kind::RequiredWhen)
    text += fmt::format(" Needed when {}.", key.fallback.when.text);
  return text;
}

// A section that holds something required and is not there at all.
void check_sections(const CaseDocument& document, std::span<const Override> overrides, const RunConfig& config,
                    Problems& problems) {
  for (const char* section : {"particle", "material", "impact"}) {
    const bool on_command_line = std::any_of(overrides.begin(), overrides.end(), [&](const Override& item) {
      return std::find(item.path.begin(), item.path.end() - 1, section) != item.path.end() - 1;
    });
    const bool in_file = std::any_of(document.tables.begin(), document.tables.end(), [&](const auto& table) {
      return table.first.section == section || table.first.part == section;
    });
    const bool is_needed =
        section != std::string_view("impact") || is_required(*find_key("impact", "speed"), config, 0);
    if (!on_command_line && !in_file && is_needed)
      problems.push_back(fmt::format("{}: the section [{}] is missing", document.file, section));
  }
}

// Whether a key that was given to all has a meaning for none of them.
bool applies_to_none(const Key& key, const RunConfig& config) {
  for (std::size_t element = 0; element < count(scope(key), config); ++element)
    if (applies(key, config, element)) return false;
  return true;
}

// Keys that are missing, and keys that mean nothing for the chosen shape.
void check_presence(const GivenKeys& own, const GivenKeys& settled, const RunConfig& config,
                    const CaseDocument& document, Problems& problems) {
  const auto refuse = [&](const Key& key, const Given& given, bool of_one_element) {
    problems.push_back(fmt::format("{}: {} does not apply: it needs that {}", given.place,
                                   full_name(key, of_one_element), key.applies.text));
  };
  for (const Key& key : schema()) {
    const auto& common = own.common[row_of(key)];
    if (common && applies_to_none(key, config)) refuse(key, *common, false);
    for (std::size_t element = 0; element < count(scope(key), config); ++element) {
      const auto& given = layer(own, key, element)[row_of(key)];
      if (given && scope(key) != Scope::Case && !applies(key, config, element)) refuse(key, *given, true);
      if (!layer(settled, key, element)[row_of(key)] && is_required(key, config, element))
        problems.push_back(missing(key, element, document));
    }
  }
  for (std::size_t i = 0; i < config.particles.size(); ++i) {
    const FractureConfig& fracture = config.particles[i].fracture;
    if (fracture.insertion != Insertion::None && fracture.fracture_energy == 0.0 && fracture.toughness == 0.0)
      problems.push_back(missing(*find_key("fracture", "fracture_energy"), i, document));
  }
}

std::string file_text(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  const std::string name = file.string();
  if (!fs::exists(status)) throw InputError(name + ": there is no such case file");
  if (fs::is_directory(status)) throw InputError(name + ": is a directory, not a case file");
  if (!fs::is_regular_file(status)) throw InputError(name + ": is not a regular file");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError(name + ": cannot be read");
  std::string text(largest_case_file + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (stream.bad()) throw InputError(name + ": cannot be read");
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return text;
}

std::vector<Setting> settings_of(std::span<const std::string> overrides) {
  return {overrides.begin(), overrides.end()};
}

RunConfig checked_config(std::string_view text, const fs::path& case_file, std::span<const Setting> settings) {
  const CaseDocument document = parse_document(text, case_file.string());
  std::vector<Override> items;
  for (const Setting& setting : settings) items.push_back(parse_override(setting));
  Problems problems;
  const GivenKeys given = read_given_keys(document, items, fs::absolute(case_file).parent_path(), problems);
  throw_if_any(problems);
  GivenKeys settled = given;
  settle_particles(settled, problems);
  RunConfig config = configured(settled);
  check_sections(document, items, config, problems);
  check_presence(given, settled, config, document, problems);
  throw_if_any(problems);
  add_derived_values(config);
  for (const std::string& contradiction : contradictions(config))
    problems.push_back(document.file + ": " + contradiction);
  throw_if_any(problems);
  return config;
}

}  // namespace

RunConfig load_config(const fs::path& case_file, std::span<const Setting> settings) {
  return checked_config(file_text(case_file), case_file, settings);
}

RunConfig load_config(const fs::path& case_file, std::span<const std::string> overrides) {
  return load_config(case_file, settings_of(overrides));
}

RunConfig config_from_text(std::string_view text, const fs::path& case_file, std::span<const std::string> overrides) {
  return checked_config(text, case_file, settings_of(overrides));
}

}  // namespace knap
