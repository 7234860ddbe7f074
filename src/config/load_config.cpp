#include "config/load_config.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <fstream>
#include <optional>

#include "config/case_document.hpp"
#include "config/derived_values.hpp"
#include "config/material_presets.hpp"
#include "config/read_value.hpp"
#include "config/schema.hpp"
#include "config/toml_guard.hpp"
#include "core/errors.hpp"

namespace knap {
namespace {

namespace fs = std::filesystem;
using Problems = std::vector<std::string>;

// A key's value and where it was given.
struct Given {
  Value value;
  std::string place;
  bool from_command_line = false;
};
using GivenKeys = std::vector<std::optional<Given>>;  // in the order of the schema

std::size_t row_of(const Key& key) { return static_cast<std::size_t>(&key - schema().data()); }

std::string full_name(const Key& key) { return key.section + "." + key.name; }

bool is_section(const std::string& name) {
  const auto names = section_names();
  return std::find(names.begin(), names.end(), name) != names.end();
}

void throw_if_any(const Problems& problems) {
  if (problems.empty()) return;
  constexpr std::size_t most_shown = 20;
  std::string text;
  for (std::size_t i = 0; i < problems.size() && i < most_shown; ++i) text += (i ? "\n" : "") + problems[i];
  if (problems.size() > most_shown) text += fmt::format("\n... and {} more", problems.size() - most_shown);
  throw InputError(text);
}

// A name from the user, on one line and of a bearable length.
std::string shown(const std::string& name) {
  const std::string quoted = as_text({name});
  return quoted.substr(1, quoted.size() - 2);
}

// "; speed belongs to [impact]" when a section has a key of that name, else the nearest key of `section`.
std::string key_advice(const std::string& section, const std::string& key) {
  const std::string near = suggestion(key, key_names(section));
  for (const std::string& other : section_names())
    if (other != section && find_key(other, key)) return fmt::format("; {} belongs to [{}]", key, other);
  return near;
}

std::string unknown_key(const Entry& entry) {
  if (!entry.section.empty())
    return fmt::format("{}: [{}] has no key \"{}\"{}", entry.place, entry.section, shown(entry.key),
                       key_advice(entry.section, entry.key));
  if (is_section(entry.key))
    return fmt::format("{}: {} = {}: is a section, write [{}] on a line of its own", entry.place, entry.key,
                       as_text(entry.value), entry.key);
  return fmt::format("{}: {} = {}: stands outside any section{}", entry.place, shown(entry.key), as_text(entry.value),
                     key_advice("", entry.key));
}

std::string unknown_section(const std::string& place, const std::string& section) {
  return fmt::format("{}: unknown section [{}]{}", place, shown(section), suggestion(section, section_names()));
}

// Checks every entry by itself; a later one (the command line) replaces an earlier one.
GivenKeys check_entries(const CaseDocument& document, const fs::path& folder, Problems& problems) {
  GivenKeys given(schema().size());
  for (const auto& [section, place] : document.sections)
    if (!is_section(section)) problems.push_back(unknown_section(place, section));
  for (const Entry& entry : document.entries) {
    if (!entry.section.empty() && !is_section(entry.section)) {
      if (entry.from_command_line) problems.push_back(unknown_section(entry.place, entry.section));
      continue;
    }
    const Key* key = find_key(entry.section, entry.key);
    if (!key) {
      problems.push_back(unknown_key(entry));
      continue;
    }
    ReadValue read = read_value(*key, entry.value, folder);
    if (!read.problem.empty())
      problems.push_back(
          fmt::format("{}: {} = {}: {}", entry.place, full_name(*key), as_text(entry.value), read.problem));
    given[row_of(*key)] = Given{std::move(read.value), entry.place, entry.from_command_line};
  }
  return given;
}

Value trusted_value(const Key& key, const std::string& text) {
  ReadValue read = read_value(key, parse_loose_value(text), {});
  assert(read.problem.empty());
  return std::move(read.value);
}

// Of the two names of one quantity the command line's wins over the file's; two from one source contradict.
void settle_fracture_energy(GivenKeys& given, Problems& problems) {
  auto& energy = given[row_of(*find_key("fracture", "fracture_energy"))];
  auto& toughness = given[row_of(*find_key("fracture", "toughness"))];
  if (!energy || !toughness) return;
  if (energy->from_command_line == toughness->from_command_line) {
    problems.push_back(fmt::format("{}: fracture.toughness: give either toughness or fracture_energy (given at {})",
                                   toughness->place, energy->place));
  }
  (energy->from_command_line ? toughness : energy).reset();
}

// The preset's values that nothing the user gave replaces.
void add_preset_values(GivenKeys& given) {
  const auto& chosen = given[row_of(*find_key("material", "preset"))];
  if (!chosen) return;
  const bool has_energy = given[row_of(*find_key("fracture", "fracture_energy"))].has_value() ||
                          given[row_of(*find_key("fracture", "toughness"))].has_value();
  for (const PresetValue& value : find_preset(std::get<std::string>(chosen->value))->values) {
    const Key& key = *find_key(value.section, value.key);
    const bool is_energy = key.name == "fracture_energy" || key.name == "toughness";
    if (!given[row_of(key)] && !(is_energy && has_energy))
      given[row_of(key)] = Given{trusted_value(key, value.text), "", false};
  }
}

RunConfig configured(const GivenKeys& given) {
  RunConfig config;
  for (const Key& key : schema()) {
    const auto& own = given[row_of(key)];
    if (own) {
      key.set(config, own->value);
    } else if (key.fallback.kind == Fallback::Kind::Text) {
      key.set(config, trusted_value(key, key.fallback.text));
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

std::string missing(const Key& key, const CaseDocument& document) {
  const auto header = document.sections.find(key.section);
  std::string text =
      fmt::format("{}: {} is missing: {}", header == document.sections.end() ? document.file : header->second,
                  full_name(key), key.description);
  if (!key.range.text.empty() && key.quantity != Quantity::Ratio)
    text += fmt::format(" For instance {} = {}.", key.name, example(key));
  if (is_in_presets(key)) text += " A material.preset gives it too.";
  if (key.fallback.kind == Fallback::Kind::RequiredWhen)
    text += fmt::format(" Needed when {}.", key.fallback.when.text);
  return text;
}

// Keys that are missing, and keys that mean nothing for the chosen shape.
void check_presence(const GivenKeys& given, const RunConfig& config, const CaseDocument& document, Problems& problems) {
  for (const char* section : {"particle", "material", "impact"}) {
    const bool on_command_line = std::any_of(document.entries.begin(), document.entries.end(),
                                             [&](const Entry& entry) { return entry.section == section; });
    if (!document.sections.contains(section) && !on_command_line)
      problems.push_back(fmt::format("{}: the section [{}] is missing", document.file, section));
  }
  for (const Key& key : schema()) {
    const auto& own = given[row_of(key)];
    if (own && !applies(key, config))
      problems.push_back(
          fmt::format("{}: {} does not apply: it needs that {}", own->place, full_name(key), key.applies.text));
    if (!own && is_required(key, config)) problems.push_back(missing(key, document));
  }
  const bool breaks = config.fracture.insertion != Insertion::None;
  if (breaks && config.fracture.fracture_energy == 0.0 && config.fracture.toughness == 0.0)
    problems.push_back(missing(*find_key("fracture", "fracture_energy"), document));
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

}  // namespace

RunConfig config_from_text(std::string_view text, const fs::path& case_file, std::span<const std::string> overrides) {
  CaseDocument document = parse_document(text, case_file.string());
  for (const std::string& item : overrides) document.entries.push_back(parse_override(item));
  Problems problems;
  GivenKeys given = check_entries(document, fs::absolute(case_file).parent_path(), problems);
  throw_if_any(problems);
  settle_fracture_energy(given, problems);
  add_preset_values(given);
  RunConfig config = configured(given);
  check_presence(given, config, document, problems);
  throw_if_any(problems);
  add_derived_values(config);
  for (const std::string& contradiction : contradictions(config))
    problems.push_back(document.file + ": " + contradiction);
  throw_if_any(problems);
  return config;
}

RunConfig load_config(const fs::path& case_file, std::span<const std::string> overrides) {
  return config_from_text(file_text(case_file), case_file, overrides);
}

}  // namespace knap
