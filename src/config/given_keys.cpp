#include "config/given_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace knap {
namespace {

using Problems = std::vector<std::string>;

// The section that a table or an override means, and of which element; no element = of the case or of all particles.
struct Slot {
  const Section* section = nullptr;
  std::optional<std::size_t> element{};
};

// A name from the user, on one line and of a bearable length.
std::string shown(const std::string& name) {
  const std::string quoted = as_text(RawValue{name});
  return quoted.substr(1, quoted.size() - 2);
}

bool is_list(const Section& section) { return section.scope != Scope::Case && !section.is_part; }

const Section* find_part(const std::string& section, const std::string& part) {
  const Section* found = find_section(part);
  return section == "particle" && found && found->is_part ? found : nullptr;
}

std::string unknown_section(const std::string& section) {
  return fmt::format("unknown section [{}]{}", shown(section), suggestion(section, section_names()));
}

// "; speed belongs to [impact]" when a section has a key of that name, else the nearest key of `section`.
std::string key_advice(const std::string& section, const std::string& key) {
  const std::string near = suggestion(key, key_names(section));
  for (const std::string& other : section_names())
    if (other != section && find_key(other, key) && !find_key(section, key))
      return near.empty() || key != "name" ? fmt::format("; {} belongs to [{}]", key, other) : near;
  return near;
}

std::string outside_any_section(const Entry& entry) {
  if (find_section(entry.key))
    return fmt::format("{}: {} = {}: is a section, write [{}] on a line of its own", entry.place, entry.key,
                       as_text(entry.value), entry.key);
  return fmt::format("{}: {} = {}: stands outside any section{}", entry.place, shown(entry.key), as_text(entry.value),
                     key_advice("", entry.key));
}

// What a table's name means, or nothing and why.
Slot slot_of_table(const TableName& name, std::string& problem) {
  const Section* section = find_section(name.section);
  if (!section) {
    if (name.part.empty()) problem = unknown_section(name.section);
    return {};
  }
  if (!name.part.empty()) {
    if (const Section* part = find_part(name.section, name.part))
      return {part, static_cast<std::size_t>(name.number.value_or(0))};
    const Key* key = find_key(name.section, name.part);
    const RawValue table{RawValue::Other{"a table"}};
    problem = key ? fmt::format("{}.{} = a table: {}", name.section, name.part, read_value(*key, table, {}).problem)
                  : fmt::format("[{}] has no key \"{}\"{}", name.section, shown(name.part),
                                key_advice(name.section, name.part));
    return {};
  }
  if (is_list(*section)) return {section, static_cast<std::size_t>(name.number.value_or(0))};
  if (name.number) problem = fmt::format("[[{0}]]: there is one of it, write [{0}]", name.section);
  return name.number ? Slot{} : Slot{section, std::nullopt};
}

std::vector<KeyLayer>& elements(GivenKeys& given, Scope scope) {
  return scope == Scope::Particle ? given.particles : given.tools;
}

// The names of a list's elements, given or by default.
std::vector<std::string> element_names(GivenKeys& given, const Section& list) {
  std::vector<std::string> names;
  const std::size_t row = row_of(*find_key(list.name, "name"));
  for (const KeyLayer& layer : elements(given, list.scope)) {
    const auto* name = layer[row] ? std::get_if<std::string>(&layer[row]->value) : nullptr;
    names.push_back(name ? *name : fmt::format("{}{}", list.name, names.size() + 1));
  }
  return names;
}

std::optional<std::size_t> only_element(GivenKeys& given, const Section& list, std::string& problem) {
  const auto names = element_names(given, list);
  if (names.size() == 1) return 0;
  problem = names.empty()
                ? fmt::format("there is no [[{}]] in the case", list.name)
                : fmt::format("there are {0}: say which, such as {1}.{2}.KEY", names.size(), list.name, names[0]);
  return std::nullopt;
}

// By name or by number, from 1.
std::optional<std::size_t> find_element(GivenKeys& given, const Section& list, const std::string& word,
                                        std::string& problem) {
  const auto names = element_names(given, list);
  const auto found = std::find(names.begin(), names.end(), word);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  std::size_t number = 0;
  const auto end = std::from_chars(word.data(), word.data() + word.size(), number);
  if (end.ec == std::errc{} && end.ptr == word.data() + word.size() && number >= 1 && number <= names.size())
    return number - 1;
  std::string list_of_names;
  for (const std::string& name : names) list_of_names += (list_of_names.empty() ? "" : ", ") + name;
  problem = names.empty() ? fmt::format("there is no [[{}]] in the case", list.name)
                          : fmt::format("there is no {} \"{}\"; there is {}", list.name, shown(word), list_of_names);
  return std::nullopt;
}

// What an override's words before the key mean: section, section.NAME, particle.part or particle.NAME.part.
Slot slot_of_override(const Override& item, GivenKeys& given, std::string& problem) {
  const Section* section = find_section(item.path[0]);
  if (!section) {
    problem = unknown_section(item.path[0]);
    return {};
  }
  if (!is_list(*section)) {
    if (item.path.size() == 2) return {section, std::nullopt};
    problem = fmt::format("[{}] has no key \"{}\"{}", section->name, shown(item.path[1]),
                          key_advice(section->name, item.path[1]));
    return {};
  }
  const Section* part = item.path.size() > 2 ? find_part(section->name, item.path[item.path.size() - 2]) : nullptr;
  const std::size_t name_words = item.path.size() - (part ? 3 : 2);
  if (name_words > 1) {
    problem = fmt::format("{} has no part \"{}\"", section->name, shown(item.path[2]));
    return {};
  }
  const auto element =
      name_words == 0 ? only_element(given, *section, problem) : find_element(given, *section, item.path[1], problem);
  return element ? Slot{part ? part : section, element} : Slot{};
}

KeyLayer& layer(GivenKeys& given, const Slot& slot) {
  return slot.element ? elements(given, slot.section->scope)[*slot.element] : given.common;
}

void read_entry(const Entry& entry, const Slot& slot, const std::filesystem::path& folder, GivenKeys& given,
                Problems& problems) {
  const std::string& section = slot.section->name;
  const Key* key = find_key(section, entry.key);
  if (!key) {
    problems.push_back(fmt::format("{}: [{}] has no key \"{}\"{}", entry.place, section, shown(entry.key),
                                   key_advice(section, entry.key)));
    return;
  }
  ReadValue read = read_value(*key, entry.value, folder);
  if (!read.problem.empty())
    problems.push_back(fmt::format("{}: {} = {}: {}", entry.place, full_name(*key, slot.element.has_value()),
                                   as_text(entry.value), read.problem));
  layer(given, slot)[row_of(*key)] = Given{std::move(read.value), entry.place, entry.from_command_line};
}

GivenKeys empty_layers(const CaseDocument& document) {
  std::size_t particles = 1, tools = 0;
  for (const auto& [name, place] : document.tables) {
    const std::size_t number = static_cast<std::size_t>(name.number.value_or(0)) + 1;
    if (name.section == "particle") particles = std::max(particles, number);
    if (name.section == "tool") tools = std::max(tools, number);
  }
  const KeyLayer empty(schema().size());
  return {empty, std::vector(particles, empty), std::vector(tools, empty)};
}

}  // namespace

std::size_t row_of(const Key& key) { return static_cast<std::size_t>(&key - schema().data()); }

std::string full_name(const Key& key, bool of_one_element) {
  const bool is_own_part = of_one_element && find_section(key.section)->is_part;
  return fmt::format("{}{}.{}", is_own_part ? "particle." : "", key.section, key.name);
}

GivenKeys read_given_keys(const CaseDocument& document, std::span<const Override> overrides,
                          const std::filesystem::path& folder, Problems& problems) {
  GivenKeys given = empty_layers(document);
  for (const auto& [name, place] : document.tables) {
    std::string problem;
    slot_of_table(name, problem);
    if (!problem.empty()) problems.push_back(place + ": " + problem);
  }
  for (const Entry& entry : document.entries) {
    std::string told_above;
    const Slot slot = slot_of_table(entry.table, told_above);
    if (slot.section) {
      read_entry(entry, slot, folder, given, problems);
    } else if (entry.table.section.empty()) {
      problems.push_back(outside_any_section(entry));
    }
  }
  for (const Override& item : overrides) {
    std::string problem;
    const Slot slot = slot_of_override(item, given, problem);
    if (slot.section)
      read_entry({{}, item.path.back(), item.value, item.place, true}, slot, folder, given, problems);
    else
      problems.push_back(item.place + ": " + problem);
  }
  return given;
}

}  // namespace knap
