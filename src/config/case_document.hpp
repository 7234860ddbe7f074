#pragma once
// A case as written: sections, keys and values with their places, before anything is known about their meaning. The
// only file of the module that knows TOML is case_document.cpp.
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace knap {

/// A TOML value.
struct RawValue {
  struct Other {
    std::string type;  ///< "a table", "a date or time"
  };
  std::variant<bool, std::int64_t, double, std::string, std::vector<RawValue>, Other> data;
};

/// The value as it could stand in a case file, on one line, shortened when long.
std::string as_text(const RawValue& value);

/// The name of a table as written: [section], [[section]] or [section.part].
struct TableName {
  std::string section;          ///< "" = outside any section
  std::string part{};           ///< "" = the section itself
  std::optional<int> number{};  ///< which [[section]], from 0; absent when written with single brackets

  auto operator<=>(const TableName&) const = default;
};

/// One `key = value`.
struct Entry {
  TableName table;
  std::string key;
  RawValue value;
  std::string place;  ///< "case.toml:12:9" or "command line --set impact.speed=3"
  bool from_command_line = false;
};

/// A value set beside the case file, by the command line or a campaign, which wins over the file's.
struct Setting {
  Setting(std::string text_, std::string place_ = "") : text(std::move(text_)), place(std::move(place_)) {}

  std::string text;   ///< "section.key=value"
  std::string place;  ///< "study.campaign.toml:12:9"; "" = --set on the command line
};

/// What a Setting says: the words before the '=', two to four of them.
struct Override {
  std::vector<std::string> path;
  RawValue value;
  std::string place;
};

struct CaseDocument {
  std::string file;                         ///< as the user named it
  std::vector<Entry> entries;               ///< in the order of the file
  std::map<TableName, std::string> tables;  ///< name -> place of its header
};

/// Parses a case file's text; `file` is only named in messages. Throws InputError.
CaseDocument parse_document(std::string_view text, const std::string& file);

/// The value that `text` is in TOML; anything else is a string, so that words and quantities need no quotes.
RawValue parse_loose_value(std::string_view text);

/// Splits "section.key=value". Throws InputError when it has another form.
Override parse_override(const Setting& setting);

}  // namespace knap
