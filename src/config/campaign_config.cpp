#include "config/campaign_config.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <numeric>
#include <set>
#include <sstream>

#include "config/case_document.hpp"
#include "config/read_value.hpp"
#include "config/toml_guard.hpp"
#include "core/errors.hpp"
#include "core/random.hpp"

namespace knap {
namespace {

namespace fs = std::filesystem;
using Problems = std::vector<std::string>;

constexpr std::size_t most_runs = 100000;
constexpr std::int64_t most_values = 10000;

/// The entries of one table by key.
struct Table {
  TableName name;
  std::string place;
  std::map<std::string, const Entry*> entries{};

  const Entry* find(const std::string& key) const {
    const auto found = entries.find(key);
    return found == entries.end() ? nullptr : found->second;
  }
  std::string header() const {
    return name.number ? fmt::format("[[{}]]", name.section) : fmt::format("[{}]", name.section);
  }
};

void complain(const Entry& entry, const std::string& what, Problems& problems) {
  problems.push_back(
      fmt::format("{}: {}.{} = {}: {}", entry.place, entry.table.section, entry.key, as_text(entry.value), what));
}

// The value as it stands behind "--set key=".
std::string override_text(const RawValue& value) {
  struct Writer {
    std::string operator()(bool x) const { return x ? "true" : "false"; }
    std::string operator()(std::int64_t x) const { return std::to_string(x); }
    std::string operator()(double x) const { return fmt::format("{}", x); }
    std::string operator()(const std::string& x) const { return x; }
    std::string operator()(const RawValue::Other& x) const { return x.type; }
    std::string operator()(const std::vector<RawValue>& items) const {
      std::vector<std::string> texts;
      for (const RawValue& item : items) {
        const bool is_text = std::holds_alternative<std::string>(item.data);
        texts.push_back(is_text ? fmt::format("\"{}\"", override_text(item)) : override_text(item));
      }
      return fmt::format("[{}]", fmt::join(texts, ", "));
    }
  };
  return std::visit(Writer{}, value.data);
}

const std::string* as_string(const RawValue& value) { return std::get_if<std::string>(&value.data); }

// A word of the form section.key, with nothing that --set would take apart.
bool is_key(const std::string& text) {
  const auto dots = std::count(text.begin(), text.end(), '.');
  return dots >= 1 && dots <= 3 && is_plain_text(text) && text.find_first_of("= \t\"") == std::string::npos &&
         text.front() != '.' && text.back() != '.' && text.find("..") == std::string::npos;
}

/// A number with what stands behind it.
struct Measure {
  double number = 0.0;
  std::string unit;
  bool is_integer = false;
};

std::optional<Measure> measure(const RawValue& value) {
  if (const auto* integer = std::get_if<std::int64_t>(&value.data))
    return Measure{static_cast<double>(*integer), "", true};
  if (const auto* number = std::get_if<double>(&value.data)) return Measure{*number, ""};
  const std::string* text = as_string(value);
  if (!text) return std::nullopt;
  Measure result;
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), result.number);
  if (error != std::errc{}) return std::nullopt;
  const std::size_t unit = text->find_first_not_of(' ', static_cast<std::size_t>(end - text->data()));
  if (unit != std::string::npos) result.unit = text->substr(unit);
  return result;
}

std::string text_of(double number, const std::string& unit, bool is_integer) {
  const std::string digits = is_integer ? fmt::format("{}", std::llround(number)) : fmt::format("{:.10g}", number);
  return unit.empty() ? digits : digits + " " + unit;
}

/// The ends of a range, as `from`, `to` and `spacing` of a table say.
struct Span {
  Measure from, to;
  bool is_logarithmic = false;
};

std::optional<Span> read_span(const Table& table, Problems& problems) {
  Span span;
  const std::size_t before = problems.size();
  for (const auto& [key, end] : {std::pair{"from", &span.from}, std::pair{"to", &span.to}}) {
    const Entry* entry = table.find(key);
    if (!entry) {
      problems.push_back(
          fmt::format("{}: {}.{} is missing: a range has both ends", table.place, table.name.section, key));
    } else if (const auto found = measure(entry->value); found && std::isfinite(found->number)) {
      *end = *found;
    } else {
      complain(*entry, "must be a number or text such as \"15 m/s\"", problems);
    }
  }
  if (const Entry* spacing = table.find("spacing")) {
    const std::string* word = as_string(spacing->value);
    if (!word || (*word != "linear" && *word != "log")) complain(*spacing, "must be \"linear\" or \"log\"", problems);
    span.is_logarithmic = word && *word == "log";
  }
  if (problems.size() > before) return std::nullopt;
  const Entry& to = *table.find("to");
  if (span.from.unit != span.to.unit)
    complain(to, fmt::format("must have the unit of from, \"{}\"", span.from.unit), problems);
  else if (!(span.from.number < span.to.number))
    complain(to, fmt::format("must be above from, {}", as_text(table.find("from")->value)), problems);
  else if (span.is_logarithmic && span.from.number <= 0.0)
    complain(*table.find("from"), "must be above 0 where spacing is \"log\"", problems);
  if (problems.size() > before) return std::nullopt;
  return span;
}

double inside(const Span& span, double part) {
  const double low = span.from.number, high = span.to.number;
  return span.is_logarithmic ? low * std::pow(high / low, part) : low + part * (high - low);
}

void read_range(const Table& table, CampaignAxis& axis, Problems& problems) {
  const auto span = read_span(table, problems);
  const Entry* count = table.find("count");
  const auto* number = count ? std::get_if<std::int64_t>(&count->value.data) : nullptr;
  if (!count)
    problems.push_back(
        fmt::format("{}: axis.count is missing: the number of values from one end to the other", table.place));
  else if (!number || *number < 2 || *number > most_values)
    complain(*count, fmt::format("must be an integer from 2 to {}", most_values), problems);
  if (!span || !number || *number < 2 || *number > most_values) return;
  const bool is_integer = span->from.is_integer && span->to.is_integer && !span->is_logarithmic &&
                          std::fmod(span->to.number - span->from.number, static_cast<double>(*number - 1)) == 0.0;
  for (std::int64_t i = 0; i < *number; ++i) {
    const double value = inside(*span, static_cast<double>(i) / static_cast<double>(*number - 1));
    axis.values.push_back({text_of(value, span->from.unit, is_integer)});
  }
}

// One key, or several that go together.
void read_axis_keys(const Table& table, CampaignAxis& axis, Problems& problems) {
  const Entry* key = table.find("key");
  const Entry* keys = table.find("keys");
  if ((key == nullptr) == (keys == nullptr)) {
    problems.push_back(
        fmt::format("{}: axis: give either key, such as \"impact.speed\", or keys, an array of them", table.place));
    return;
  }
  const Entry& entry = key ? *key : *keys;
  std::vector<RawValue> names{entry.value};
  if (keys) {
    const auto* list = std::get_if<std::vector<RawValue>>(&entry.value.data);
    names = list ? *list : std::vector<RawValue>{};
  }
  for (const RawValue& name : names)
    if (const std::string* text = as_string(name); text && is_key(*text)) axis.keys.push_back(*text);
  if (names.empty() || axis.keys.size() != names.size())
    complain(entry, "must name keys of the case, such as \"impact.speed\"", problems);
}

void read_values(const Entry& entry, CampaignAxis& axis, Problems& problems) {
  const auto* list = std::get_if<std::vector<RawValue>>(&entry.value.data);
  if (!list || list->empty() || static_cast<std::int64_t>(list->size()) > most_values) {
    complain(entry, fmt::format("must be an array of 1 to {} values", most_values), problems);
    return;
  }
  for (const RawValue& item : *list) {
    const auto* parts = std::get_if<std::vector<RawValue>>(&item.data);
    if (axis.keys.size() <= 1) {
      axis.values.push_back({override_text(item)});
    } else if (parts && parts->size() == axis.keys.size()) {
      axis.values.emplace_back();
      for (const RawValue& part : *parts) axis.values.back().push_back(override_text(part));
    } else {
      complain(entry, fmt::format("each must be an array of {}, one for each of keys", axis.keys.size()), problems);
      return;
    }
  }
}

void read_axis(const Table& table, CampaignConfig& campaign, Problems& problems) {
  const Entry* values = table.find("values");
  CampaignAxis axis{.keys = {}, .values = {}, .place = values ? values->place : table.place};
  read_axis_keys(table, axis, problems);
  const bool has_range = table.find("from") || table.find("to") || table.find("count") || table.find("spacing");
  if (values && has_range)
    complain(*values, "give either values, or from, to, count and spacing", problems);
  else if (values)
    read_values(*values, axis, problems);
  else if (axis.keys.size() > 1)
    problems.push_back(
        fmt::format("{}: axis.values is missing: keys that go together take listed values", table.place));
  else
    read_range(table, axis, problems);
  if (std::set(axis.values.begin(), axis.values.end()).size() != axis.values.size())
    problems.push_back(fmt::format("{}: axis: a value is there twice", table.place));
  campaign.axes.push_back(std::move(axis));
}

void read_sample(const Table& table, CampaignConfig& campaign, Problems& problems) {
  const Entry* key = table.find("key");
  const std::string* name = key ? as_string(key->value) : nullptr;
  if (!key)
    problems.push_back(fmt::format("{}: sample.key is missing, such as \"fracture.toughness\"", table.place));
  else if (!name || !is_key(*name))
    complain(*key, "must name a key of the case, such as \"fracture.toughness\"", problems);
  if (const auto span = read_span(table, problems); span && name)
    campaign.sampled.push_back({.key = *name,
                                .low = span->from.number,
                                .high = span->to.number,
                                .unit = span->from.unit,
                                .is_logarithmic = span->is_logarithmic,
                                .is_integer = span->from.is_integer && span->to.is_integer,
                                .place = table.place});
}

void read_integer(const Table& table, const std::string& key, std::int64_t low, std::int64_t high, std::int64_t& into,
                  Problems& problems) {
  const Entry* entry = table.find(key);
  if (!entry) return;
  const auto* number = std::get_if<std::int64_t>(&entry->value.data);
  if (number && *number >= low && *number <= high)
    into = *number;
  else
    complain(*entry, fmt::format("must be an integer from {} to {}", low, high), problems);
}

void read_set(const Table& table, CampaignConfig& campaign, Problems& problems) {
  for (const auto& [key, entry] : table.entries) {
    const std::string full = table.name.part.empty() ? key : table.name.part + "." + key;
    if (is_key(full))
      campaign.settings.emplace_back(fmt::format("{}={}", full, override_text(entry->value)), entry->place);
    else
      complain(*entry, "must be a key of the case in quotes, such as \"output.frames\" = 0", problems);
  }
}

// What a section may hold; [set] takes anything.
const std::map<std::string, std::vector<std::string>>& known_keys() {
  static const std::map<std::string, std::vector<std::string>> known{
      {"campaign", {"base"}},
      {"set", {}},
      {"axis", {"key", "keys", "values", "from", "to", "count", "spacing"}},
      {"latin_hypercube", {"samples", "seed"}},
      {"sample", {"key", "from", "to", "spacing"}}};
  return known;
}

bool is_list(const std::string& section) { return section == "axis" || section == "sample"; }

void check_names(const Table& table, Problems& problems) {
  const auto known = known_keys().find(table.name.section);
  if (known == known_keys().end()) {
    std::vector<std::string> names;
    for (const auto& [name, keys] : known_keys()) names.push_back(name);
    problems.push_back(
        fmt::format("{}: unknown section {}{}", table.place, table.header(), suggestion(table.name.section, names)));
    return;
  }
  if (is_list(table.name.section) != table.name.number.has_value())
    problems.push_back(fmt::format("{}: write {}", table.place,
                                   is_list(table.name.section) ? fmt::format("[[{}]]", table.name.section)
                                                               : fmt::format("[{}]", table.name.section)));
  if (table.name.section == "set") return;
  if (!table.name.part.empty())
    problems.push_back(fmt::format("{}: [{}] has no table \"{}\"", table.place, table.name.section, table.name.part));
  for (const auto& [key, entry] : table.entries)
    if (std::find(known->second.begin(), known->second.end(), key) == known->second.end())
      problems.push_back(
          fmt::format("{}: {} has no key \"{}\"{}", entry->place, table.header(), key, suggestion(key, known->second)));
}

std::vector<Table> tables_of(const CaseDocument& document, Problems& problems) {
  std::map<TableName, Table> tables;
  for (const auto& [name, place] : document.tables) tables[name] = {name, place};
  for (const Entry& entry : document.entries) {
    if (entry.table.section.empty()) {
      problems.push_back(
          fmt::format("{}: {} = {}: stands outside any section", entry.place, entry.key, as_text(entry.value)));
      continue;
    }
    tables[entry.table].entries[entry.key] = &entry;
  }
  std::vector<Table> list;
  for (auto& [name, table] : tables) list.push_back(std::move(table));
  return list;
}

void read_base(const Table* table, const fs::path& folder, const std::string& file, CampaignConfig& campaign,
               Problems& problems) {
  const Entry* base = table ? table->find("base") : nullptr;
  const std::string* path = base ? as_string(base->value) : nullptr;
  if (!base)
    problems.push_back(
        fmt::format("{}: campaign.base is missing: the case file to start from", table ? table->place : file));
  else if (!path || path->empty())
    complain(*base, "must be a path in quotes", problems);
  else if (campaign.base = folder / *path; !fs::is_regular_file(campaign.base))
    complain(
        *base,
        fmt::format("there is no case file {}; the path is relative to the campaign's file", campaign.base.string()),
        problems);
}

// Each key once, and no more runs than anyone wants by mistake.
void check_whole(const CampaignConfig& campaign, const std::string& file, Problems& problems) {
  std::set<std::string> seen;
  for (const std::string& key : campaign_keys(campaign))
    if (!seen.insert(key).second) problems.push_back(fmt::format("{}: {} varies twice", file, key));
  if (campaign.sampled.empty() != (campaign.samples == 0))
    problems.push_back(fmt::format("{}: {}", file,
                                   campaign.sampled.empty() ? "latin_hypercube.samples needs a [[sample]]"
                                                            : "[[sample]] needs latin_hypercube.samples"));
  if (seen.empty()) problems.push_back(fmt::format("{}: nothing varies: add an [[axis]]", file));
  double runs = std::max(1, campaign.samples);
  for (const CampaignAxis& axis : campaign.axes) runs *= static_cast<double>(axis.values.size());
  if (runs > static_cast<double>(most_runs)) {
    problems.push_back(fmt::format("{}: {:.3g} runs, allowed are {}", file, runs, most_runs));
    return;
  }
  std::set<std::string> names;
  for (const CampaignRun& run : campaign_runs(campaign))
    if (!names.insert(run.name).second)
      problems.push_back(
          fmt::format("{}: two runs would have the folder {}: write their values in another way", file, run.name));
}

// The row of the schema: the last word of tool.NAME.key, particle.NAME.mesh.key is of [tool], [mesh].
const Key* schema_key(const std::string& key) {
  std::vector<std::string> words;
  std::stringstream stream(key);
  for (std::string word; std::getline(stream, word, '.');) words.push_back(word);
  for (std::size_t i = words.size() - 1; i-- > 0;)
    if (const Key* found = find_key(words[i], words.back())) return found;
  return nullptr;
}

// "speed_8mps" for impact.speed = "8 m/s": what a folder's name takes.
std::string name_part(const std::string& key, const std::string& value) {
  std::string text = key.substr(key.rfind('.') + 1) + "_";
  for (const char c : value) {
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '-' || c == '+')
      text += c;
    else if (c == '/')
      text += 'p';
  }
  return text;
}

// Readable, and with a checksum of the values where that is not enough: too long, or characters were left out.
std::string run_name(const std::vector<std::string>& keys, const std::vector<std::string>& values) {
  constexpr std::size_t longest = 120;
  std::vector<std::string> parts;
  bool is_whole = true;
  std::uint64_t sum = 14695981039346656037ULL;  // FNV-1a
  for (std::size_t k = 0; k < keys.size(); ++k) {
    parts.push_back(name_part(keys[k], values[k]));
    const auto is_dropped = [](char c) {
      return !std::isalnum(static_cast<unsigned char>(c)) && !std::strchr(".-+/ ", c);
    };
    is_whole = is_whole && std::none_of(values[k].begin(), values[k].end(), is_dropped);
    for (const char c : keys[k] + "=" + values[k] + ";") sum = (sum ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  }
  std::string name = fmt::format("{}", fmt::join(parts, "-"));
  if (is_whole && name.size() <= longest) return name;
  return fmt::format("{}-{:08x}", name.substr(0, longest), sum >> 32U);
}

// One value of every stratum, in an order of its own for each key (McKay, Beckman & Conover 1979).
std::vector<std::string> sampled_values(const CampaignConfig& campaign, std::size_t key) {
  const SampledKey& sampled = campaign.sampled[key];
  std::uint64_t state = static_cast<std::uint64_t>(campaign.sample_seed) * 0x9e3779b97f4a7c15ULL + key;
  std::vector<int> strata(static_cast<std::size_t>(campaign.samples));
  std::iota(strata.begin(), strata.end(), 0);
  for (std::size_t i = strata.size(); i > 1; --i)
    std::swap(strata[i - 1], strata[static_cast<std::size_t>(splitmix64(state) % i)]);
  const Span span{{sampled.low, sampled.unit}, {sampled.high, sampled.unit}, sampled.is_logarithmic};
  std::vector<std::string> values;
  for (const int stratum : strata) {
    const double value = inside(span, (stratum + uniform01(state)) / campaign.samples);
    values.push_back(text_of(value, sampled.unit, sampled.is_integer));
  }
  return values;
}

}  // namespace

CampaignConfig campaign_from_text(std::string_view text, const fs::path& file) {
  const CaseDocument document = parse_document(text, file.string());
  Problems problems;
  CampaignConfig campaign;
  const std::vector<Table> tables = tables_of(document, problems);
  const Table* head = nullptr;
  std::int64_t samples = 0;
  for (const Table& table : tables) {
    const std::size_t before = problems.size();
    check_names(table, problems);
    if (problems.size() > before) continue;
    if (table.name.section == "campaign") head = &table;
    if (table.name.section == "set") read_set(table, campaign, problems);
    if (table.name.section == "axis") read_axis(table, campaign, problems);
    if (table.name.section == "sample") read_sample(table, campaign, problems);
    if (table.name.section != "latin_hypercube") continue;
    read_integer(table, "samples", 1, most_values, samples, problems);
    read_integer(table, "seed", 0, 1000000000000000, campaign.sample_seed, problems);
  }
  campaign.samples = static_cast<int>(samples);
  read_base(head, file.parent_path(), file.string(), campaign, problems);
  if (problems.empty()) check_whole(campaign, file.string(), problems);
  throw_if_any(problems);
  return campaign;
}

CampaignConfig load_campaign(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || fs::is_directory(file)) throw InputError(fmt::format("{}: cannot read this file", file.string()));
  std::stringstream text;
  text << stream.rdbuf();
  return campaign_from_text(text.str(), file);
}

std::vector<std::string> campaign_keys(const CampaignConfig& campaign) {
  std::vector<std::string> keys;
  for (const CampaignAxis& axis : campaign.axes) keys.insert(keys.end(), axis.keys.begin(), axis.keys.end());
  for (const SampledKey& sampled : campaign.sampled) keys.push_back(sampled.key);
  return keys;
}

std::vector<CampaignRun> campaign_runs(const CampaignConfig& campaign) {
  std::vector<std::vector<std::string>> rows{{}};
  for (const CampaignAxis& axis : campaign.axes) {
    std::vector<std::vector<std::string>> longer;
    for (const auto& row : rows)
      for (const auto& value : axis.values) {
        longer.push_back(row);
        longer.back().insert(longer.back().end(), value.begin(), value.end());
      }
    rows = std::move(longer);
  }
  if (campaign.samples > 0) {
    std::vector<std::vector<std::string>> columns;
    for (std::size_t k = 0; k < campaign.sampled.size(); ++k) columns.push_back(sampled_values(campaign, k));
    std::vector<std::vector<std::string>> longer;
    for (const auto& row : rows)
      for (std::size_t i = 0; i < static_cast<std::size_t>(campaign.samples); ++i) {
        longer.push_back(row);
        for (const auto& column : columns) longer.back().push_back(column[i]);
      }
    rows = std::move(longer);
  }
  std::vector<CampaignRun> runs;
  for (auto& row : rows) runs.push_back({run_name(campaign_keys(campaign), row), std::move(row)});
  return runs;
}

std::string column_of(const std::string& key) {
  const Key* found = schema_key(key);
  const bool has_unit = found && (found->type == KeyType::Quantity || found->type == KeyType::Vector);
  return has_unit ? fmt::format("{} [{}]", key, si_unit(found->quantity)) : key;
}

Value value_of(const std::string& key, const std::string& text) {
  const Key* found = schema_key(key);
  if (!found) return text;
  ReadValue read = read_value(*found, parse_loose_value(text), {});
  if (!read.problem.empty()) throw InputError(fmt::format("{} = {}: {}", key, text, read.problem));
  return read.value;
}

std::vector<Setting> settings_of(const CampaignConfig& campaign, const CampaignRun& run) {
  std::vector<Setting> settings = campaign.settings;
  std::size_t next = 0;
  const auto set = [&](const std::string& key, const std::string& place) {
    settings.emplace_back(fmt::format("{}={}", key, run.values[next++]), place);
  };
  for (const CampaignAxis& axis : campaign.axes)
    for (const std::string& key : axis.keys) set(key, axis.place);
  for (const SampledKey& sampled : campaign.sampled) set(sampled.key, sampled.place);
  return settings;
}

}  // namespace knap
