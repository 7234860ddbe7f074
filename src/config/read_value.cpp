#include "config/read_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "config/toml_guard.hpp"
#include "core/errors.hpp"

namespace knap {
namespace {

std::string unit_advice(Quantity quantity) {
  if (quantity == Quantity::Ratio) return "a number";
  return fmt::format("a number in {} or text such as \"{}\"", si_unit(quantity), sample_value(quantity));
}

std::string type_advice(const Key& key) {
  switch (key.type) {
    case KeyType::Quantity:
      return fmt::format("must be {}: {}", name(key.quantity), unit_advice(key.quantity));
    case KeyType::Vector:
      return fmt::format("must be an array of three, each {}", unit_advice(key.quantity));
    case KeyType::Integer:
      return fmt::format("must be an integer {}", in_words(key.range));
    case KeyType::Switch:
      return "must be true or false";
    case KeyType::Choice:
      return "must be a word in quotes";
    case KeyType::Name:
      return "must be a word in quotes of letters, digits, - and _, beginning with a letter, of at most 40 characters";
    case KeyType::File:
      break;
  }
  return "must be a path in quotes";
}

bool inside(const Range& range, double x) {
  const bool above = range.low_open ? x > range.low : x >= range.low;
  const bool below = range.high_open ? x < range.high : x <= range.high;
  return above && below;
}

std::string range_advice(const Key& key, bool bare_number) {
  std::string text = "must be " + in_words(key.range);
  if (bare_number && key.quantity == Quantity::Angle) {
    text += "; a bare number is in radians, write degrees as text such as \"60 deg\"";
  } else if (bare_number && key.quantity != Quantity::Ratio) {
    text += fmt::format("; a bare number is in {}, other units as text such as \"{}\"", si_unit(key.quantity),
                        sample_value(key.quantity));
  }
  return text;
}

struct Number {
  double value = 0.0;
  std::string problem;
};

Number read_number(const Key& key, const RawValue& raw) {
  Number number;
  bool bare = true;
  if (const auto* integer = std::get_if<std::int64_t>(&raw.data)) {
    number.value = static_cast<double>(*integer);
  } else if (const auto* real = std::get_if<double>(&raw.data)) {
    number.value = *real;
  } else if (const auto* text = std::get_if<std::string>(&raw.data)) {
    Conversion converted = convert_to_si(*text, key.quantity);
    if (!converted.problem.empty()) return {0.0, std::move(converted.problem)};
    number.value = converted.value;
    bare = false;
  } else {
    return {0.0, type_advice(key)};
  }
  if (!std::isfinite(number.value)) return {0.0, "must be a finite number, " + in_words(key.range)};
  if (!inside(key.range, number.value)) number.problem = range_advice(key, bare);
  return number;
}

ReadValue read_quantity(const Key& key, const RawValue& raw) {
  Number number = read_number(key, raw);
  return {number.value, std::move(number.problem)};
}

ReadValue read_vector(const Key& key, const RawValue& raw) {
  const auto* items = std::get_if<std::vector<RawValue>>(&raw.data);
  if (!items || items->size() != 3) return {{}, type_advice(key)};
  Vec3 vector;
  for (std::size_t i = 0; i < 3; ++i) {
    const Number number = read_number(key, (*items)[i]);
    if (!number.problem.empty()) return {{}, fmt::format("entry {}: {}", i + 1, number.problem)};
    vector[static_cast<Eigen::Index>(i)] = number.value;
  }
  return {vector, ""};
}

ReadValue read_integer(const Key& key, const RawValue& raw) {
  const auto* integer = std::get_if<std::int64_t>(&raw.data);
  if (!integer || !inside(key.range, static_cast<double>(*integer))) return {{}, type_advice(key)};
  return {*integer, ""};
}

ReadValue read_choice(const Key& key, const RawValue& raw) {
  const auto* word = std::get_if<std::string>(&raw.data);
  if (!word) return {{}, type_advice(key)};
  std::string list;
  for (const std::string& choice : key.choices) {
    if (choice == *word) return {*word, ""};
    list += (list.empty() ? "" : ", ") + choice;
  }
  return {{}, fmt::format("must be one of {}{}", list, suggestion(*word, key.choices))};
}

ReadValue read_name(const Key& key, const RawValue& raw) {
  constexpr std::size_t longest_name = 40;
  const auto* word = std::get_if<std::string>(&raw.data);
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto fits = [&](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '-' || c == '_'; };
  if (!word || word->empty() || word->size() > longest_name || !is_letter(word->front()) ||
      !std::all_of(word->begin(), word->end(), fits))
    return {{}, type_advice(key)};
  return {*word, ""};
}

// A path as absolute text that effective.toml can hold.
ReadValue read_file(const Key& key, const RawValue& raw, const std::filesystem::path& folder) {
  const auto* text = std::get_if<std::string>(&raw.data);
  if (!text || text->empty()) return {{}, type_advice(key)};
  const std::filesystem::path path = (folder / *text).lexically_normal();
  if (!is_plain_text(path.string()) || path.string().size() > longest_path) return {{}, "is not a usable path"};
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) return {{}, fmt::format("there is no file {}", path.string())};
  if (!std::filesystem::is_regular_file(status)) return {{}, fmt::format("{} is not a regular file", path.string())};
  if (!std::ifstream(path)) return {{}, fmt::format("{} cannot be read", path.string())};
  return {path.string(), ""};
}

}  // namespace

std::string suggestion(const std::string& word, const std::vector<std::string>& candidates) {
  if (word.size() > 64) return "";
  std::string nearest = nearest_name(word, candidates);
  for (const std::string& candidate : candidates)
    if (nearest.empty() && word.size() >= 3 && candidate.starts_with(word)) nearest = candidate;
  return nearest.empty() ? "" : fmt::format(" (did you mean \"{}\"?)", nearest);
}

ReadValue read_value(const Key& key, const RawValue& raw, const std::filesystem::path& folder) {
  switch (key.type) {
    case KeyType::Quantity:
      return read_quantity(key, raw);
    case KeyType::Vector:
      return read_vector(key, raw);
    case KeyType::Integer:
      return read_integer(key, raw);
    case KeyType::Choice:
      return read_choice(key, raw);
    case KeyType::File:
      return read_file(key, raw, folder);
    case KeyType::Name:
      return read_name(key, raw);
    case KeyType::Switch:
      break;
  }
  const auto* on = std::get_if<bool>(&raw.data);
  return on ? ReadValue{*on, ""} : ReadValue{{}, type_advice(key)};
}

}  // namespace knap
