// The schema as text for people: the table of `knap keys` and the page docs/case_reference.md.
#include <fmt/format.h>

#include <algorithm>

#include "config/material_presets.hpp"
#include "config/schema.hpp"

namespace knap {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

// What is to be written: a unit, a type, or nothing for words, whose choices stand in the column "allowed".
std::string written_as(const Key& key) {
  switch (key.type) {
    case KeyType::Quantity:
      return key.quantity == Quantity::Ratio ? "number" : std::string(si_unit(key.quantity));
    case KeyType::Vector:
      return fmt::format("3 x {}", si_unit(key.quantity));
    case KeyType::Integer:
      return "integer";
    case KeyType::Switch:
      return "switch";
    case KeyType::Choice:
      return "word";
    case KeyType::Name:
      return "name";
    case KeyType::File:
      break;
  }
  return "path";
}

std::string allowed(const Key& key) {
  if (key.type == KeyType::Switch) return "true, false";
  if (key.type == KeyType::Choice) return joined(key.choices);
  if (key.type == KeyType::File) return "a readable file";
  if (key.type == KeyType::Name) return "up to 40 characters";
  return key.range.text;
}

std::string described(const Key& key) {
  if (key.applies.text.empty()) return key.description;
  return fmt::format("{} Only when {}.", key.description, key.applies.text);
}

void add_section_table(std::string& page, const Section& section) {
  const char* form = section.scope == Scope::Tool ? "\n## [[{}]]\n" : "\n## [{}]\n";
  page += fmt::format(fmt::runtime(form), section.name);
  if (!section.note.empty()) page += "\n" + section.note + "\n";
  page += "\n| key | unit or type | allowed | default | meaning |\n|---|---|---|---|---|\n";
  for (const Key& key : schema())
    if (key.section == section.name)
      page += fmt::format("| `{}` | {} | {} | {} | {} |\n", key.name, written_as(key), allowed(key), key.fallback.text,
                          described(key));
}

void add_units(std::string& page) {
  page += "\n## Units\n\n| quantity | bare number | units, with the usual prefixes | example |\n|---|---|---|---|\n";
  for (int i = 0; i < static_cast<int>(Quantity::Count); ++i) {
    const auto quantity = static_cast<Quantity>(i);
    page += fmt::format("| {} | {} | {} | `\"{}\"` |\n", name(quantity), si_unit(quantity), sample_units(quantity),
                        sample_value(quantity));
  }
}

void add_placement(std::string& page) {
  page +=
      "\n## Where things start\n\n"
      "A particle without a `position` stands on the plane z = 0, a thousandth of an element above it, its centre on "
      "the\nz axis, whether there is a wall or not. A tool without a `position` is put where it just touches the "
      "particles,\nthe same gap away: it comes from where its `velocity` comes from; without one a plane or platen "
      "from behind its\n`normal`, any other tool from below. A tool must not overlap a particle at the start, nor "
      "a particle another one.\n";
}

void add_presets(std::string& page) {
  page += "\n## Presets of [material]\n\nEach value is a default that the case can override.\n";
  for (const MaterialPreset& preset : material_presets()) {
    page += fmt::format("\n### {}\n\n{}.\n\n| key | value | source |\n|---|---|---|\n", preset.name, preset.title);
    for (const PresetValue& value : preset.values)
      page += fmt::format("| `{}.{}` | {} | {} |\n", value.section, value.key, value.text, value.source);
  }
}

}  // namespace

std::string describe_keys() {
  std::vector<std::array<std::string, 4>> rows{{"KEY", "UNIT", "ALLOWED", "DEFAULT"}};
  for (const Key& key : schema())
    rows.push_back({key.section + "." + key.name, written_as(key), allowed(key), key.fallback.text});
  std::array<std::size_t, 4> width{};
  for (const auto& row : rows)
    for (std::size_t column = 0; column < 4; ++column)
      width[column] = std::min<std::size_t>(std::max(width[column], row[column].size()), 42);
  std::string table;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string meaning = i == 0 ? "MEANING" : described(schema()[i - 1]);
    for (std::size_t column = 0; column < 4; ++column) table += fmt::format("{:<{}}  ", rows[i][column], width[column]);
    table += meaning + "\n";
  }
  return table;
}

std::string keys_as_markdown() {
  std::string page =
      "# Case reference\n\n"
      "Every section and key of a case file. This page is generated from the table that also reads the case\n"
      "(`src/config/schema.cpp`); the same table in the terminal: `knap keys`. `cases/normal_impact.toml` is a case to "
      "copy\n"
      "from. [particle], [material] and, without a [[tool]], [impact] must be there; an unknown key is an error.\n\n"
      "A quantity is a bare number in SI or text with a unit, such as `speed = \"15 m/s\"`. In the column \"allowed\" "
      "a\n"
      "square bracket includes the end of the interval, a round one excludes it. Any key can be set from the command "
      "line,\n"
      "`--set impact.speed=15m/s`, which wins over the case file; of several particles or tools by name or number,\n"
      "`--set tool.NAME.friction=0.2`, `--set particle.2.material.density=1200`.\n";
  for (const Section& section : sections()) add_section_table(page, section);
  add_placement(page);
  add_units(page);
  add_presets(page);
  return page;
}

}  // namespace knap
