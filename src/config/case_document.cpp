#include "config/case_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <toml.hpp>

#include "config/toml_guard.hpp"
#include "core/errors.hpp"

namespace knap {
namespace {

// Text on one line without control characters, at most 60 bytes of it.
std::string shortened(std::string_view text) {
  std::string clean(text.substr(0, 60));
  while (!clean.empty() && clean.size() < text.size() && (text[clean.size()] & 0xC0) == 0x80) clean.pop_back();
  for (char& c : clean)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = '?';
  return clean.size() < text.size() ? clean + "..." : clean;
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t") + 1 - first);
}

RawValue to_raw(const toml::value& value) {
  switch (value.type()) {
    case toml::value_t::boolean:
      return {value.as_boolean()};
    case toml::value_t::integer:
      return {static_cast<std::int64_t>(value.as_integer())};
    case toml::value_t::floating:
      return {value.as_floating()};
    case toml::value_t::string:
      return {value.as_string().str};
    case toml::value_t::table:
      return {RawValue::Other{"a table"}};
    case toml::value_t::array:
      break;
    default:
      return {RawValue::Other{"a date or time"}};
  }
  std::vector<RawValue> items;
  for (const auto& item : value.as_array()) items.push_back(to_raw(item));
  return {std::move(items)};
}

// One source line that toml11 quotes in an error, with the column it points at and its remark.
struct QuotedLine {
  std::string line, column, text, remark;
};

// toml11 quotes as " 12 | speed = 15 m/s\n    |          ^--- remark".
std::vector<QuotedLine> quoted_lines(const std::string& what) {
  std::vector<QuotedLine> found;
  std::istringstream stream(what);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t bar = line.find(" | ");
    const std::size_t digit = line.find_first_not_of(' ');
    if (bar == std::string::npos || digit == std::string::npos) continue;
    if (digit < bar &&
        std::all_of(line.begin() + static_cast<std::ptrdiff_t>(digit), line.begin() + static_cast<std::ptrdiff_t>(bar),
                    [](char c) { return c >= '0' && c <= '9'; })) {
      found.push_back({line.substr(digit, bar - digit), "1", line.substr(bar + 3), ""});
    } else if (!found.empty() && digit > bar) {
      const std::size_t mark = std::min(line.find_first_of("^~"), line.size());
      const std::size_t remark = std::min(line.find_first_not_of("^~-", mark), line.size());
      found.back().column = std::to_string(mark > bar + 3 ? mark - bar - 2 : 1);
      found.back().remark = line.substr(std::min(remark + 1, line.size()));
    }
  }
  return found;
}

// The complaint without toml11's prefixes, as "[error] toml::parse_table: invalid line format".
std::string complaint(const std::string& what) {
  std::string text = what.substr(0, what.find('\n'));
  for (const std::string_view mark : {"[error] ", "toml::"})
    if (const std::size_t at = text.find(mark); at == 0) text.erase(0, mark.size());
  const std::size_t name_end = text.find(": ");
  if (name_end != std::string::npos && text.find(' ') > name_end) text.erase(0, name_end + 2);
  return text;
}

// The commonest mistake is a quantity or word without quotes.
std::string quotes_advice(const std::string& line) {
  const std::size_t equals = line.find('=');
  if (equals == std::string::npos) return "";
  const std::size_t start = line.find_first_not_of(" \t", equals + 1);
  if (start == std::string::npos) return "";
  const std::string value = line.substr(start, line.find_last_not_of(" \t\r") + 1 - start);
  if (value.find_first_of("\"'[{#") != std::string::npos) return "";
  return fmt::format("; words and values with a unit need quotes: \"{}\"", shortened(value));
}

std::string rewritten(const std::string& what, const std::string& file) {
  const std::vector<QuotedLine> lines = quoted_lines(what);
  if (lines.empty()) return fmt::format("{}: not a TOML file: {}", file, shortened(complaint(what)));
  const QuotedLine& last = lines.back();
  const std::string place = fmt::format("{}:{}:{}", file, last.line, last.column);
  if (what.find("already exists") != std::string::npos)
    return fmt::format("{}: {} is given twice (first in line {})", place,
                       shortened(trimmed(last.text.substr(0, last.text.find('=')))), lines.front().line);
  return fmt::format("{}: not valid TOML: {}{}{}{}", place, complaint(what), last.remark.empty() ? "" : ": ",
                     last.remark, quotes_advice(last.text));
}

toml::value parse_toml(std::string_view text, const std::string& file) {
  if (const std::string reason = reason_to_refuse(text); !reason.empty())
    throw InputError(fmt::format("{}:{}", file, reason));
  std::istringstream stream{std::string(text)};
  try {
    return toml::parse(stream, file);
  } catch (const std::exception& error) {
    throw InputError(rewritten(error.what(), file));
  }
}

struct PlacedEntry {
  toml::source_location location;
  Entry entry;
};

std::string place_text(const std::string& file, const toml::source_location& location) {
  return fmt::format("{}:{}:{}", file, location.line(), location.column());
}

bool is_array_of_tables(const toml::value& value) {
  if (!value.is_array()) return false;
  const auto& items = value.as_array();
  return !items.empty() && std::all_of(items.begin(), items.end(), [](const auto& item) { return item.is_table(); });
}

// Collects the entries of a file with the tables they stand in.
struct Collector {
  CaseDocument& document;
  std::vector<PlacedEntry> placed{};

  void add_entry(const TableName& table, const std::string& key, const toml::value& value) {
    const auto location = value.location();
    placed.push_back({location, {table, key, to_raw(value), place_text(document.file, location), false}});
  }

  // A table inside a section may be a part of it, or a value that should not be one: the reader of keys decides.
  void add_table(const TableName& name, const toml::value& table) {
    document.tables[name] = place_text(document.file, table.location());
    for (const auto& [key, value] : table.as_table()) {
      if (value.is_table() && name.part.empty()) {
        add_table({name.section, key, name.number}, value);
      } else {
        add_entry(name, key, value);
      }
    }
  }

  void add_root(const toml::value& root) {
    for (const auto& [section, content] : root.as_table()) {
      if (content.is_table()) {
        add_table({section}, content);
      } else if (is_array_of_tables(content)) {
        int number = 0;
        for (const auto& table : content.as_array()) add_table({section, "", number++}, table);
      } else {
        add_entry({}, section, content);
      }
    }
  }
};

}  // namespace

std::string as_text(const RawValue& value) {
  struct Writer {
    std::string operator()(bool x) const { return x ? "true" : "false"; }
    std::string operator()(std::int64_t x) const { return std::to_string(x); }
    std::string operator()(double x) const { return fmt::format("{}", x); }
    std::string operator()(const std::string& x) const { return "\"" + shortened(x) + "\""; }
    std::string operator()(const RawValue::Other& x) const { return x.type; }
    std::string operator()(const std::vector<RawValue>& items) const {
      std::string text = "[";
      for (std::size_t i = 0; i < items.size() && i < 4; ++i) text += (i ? ", " : "") + as_text(items[i]);
      return text + (items.size() > 4 ? ", ...]" : "]");
    }
  };
  return std::visit(Writer{}, value.data);
}

CaseDocument parse_document(std::string_view text, const std::string& file) {
  const toml::value root = parse_toml(text, file);
  CaseDocument document{file, {}, {}};
  Collector collector{document};
  collector.add_root(root);
  std::vector<PlacedEntry>& placed = collector.placed;
  std::sort(placed.begin(), placed.end(), [](const PlacedEntry& a, const PlacedEntry& b) {
    return std::tuple(a.location.line(), a.location.column(), a.entry.table, a.entry.key) <
           std::tuple(b.location.line(), b.location.column(), b.entry.table, b.entry.key);
  });
  for (auto& item : placed) document.entries.push_back(std::move(item.entry));
  return document;
}

RawValue parse_loose_value(std::string_view text) {
  if (text.find('\n') == std::string_view::npos) {
    try {
      const toml::value root = parse_toml("value = " + std::string(text), "value");
      if (root.as_table().size() == 1) return to_raw(root.as_table().at("value"));
    } catch (const InputError&) {  // a bare word or quantity
    }
  }
  return {std::string(text)};
}

Override parse_override(const Setting& setting) {
  const std::string& text = setting.text;
  const std::string place = setting.place.empty() ? "command line --set " + shortened(text) : setting.place;
  const std::size_t equals = text.find('=');
  std::vector<std::string> path{""};
  for (const char c : trimmed(text.substr(0, equals))) {
    if (c == '.') {
      path.emplace_back();
    } else {
      path.back() += c;
    }
  }
  const bool has_gap = std::any_of(path.begin(), path.end(), [](const std::string& word) { return word.empty(); });
  if (equals == std::string::npos || has_gap || path.size() < 2 || path.size() > 4)
    throw InputError(place + ": must have the form section.key=value, such as impact.speed=15m/s");
  const std::string value = trimmed(text.substr(equals + 1));
  if (value.empty()) throw InputError(place + ": has no value after '='");
  return {std::move(path), parse_loose_value(value), place};
}

}  // namespace knap
