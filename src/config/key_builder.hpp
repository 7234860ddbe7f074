#pragma once
// Parts from which the rows of the schema are written: types, ranges, fallbacks, and access to a field of RunConfig.
#include <algorithm>
#include <string_view>

#include "config/schema.hpp"

namespace knap {

/// How a key's value is read from and written to an element of the configuration.
struct Access {
  std::function<Value(const RunConfig&, std::size_t)> get;
  std::function<void(RunConfig&, std::size_t, const Value&)> set;
};

inline void assign(double& field, const Value& value) { field = std::get<double>(value); }
inline void assign(std::optional<double>& field, const Value& value) { field = std::get<double>(value); }
inline void assign(std::int64_t& field, const Value& value) { field = std::get<std::int64_t>(value); }
inline void assign(int& field, const Value& value) { field = static_cast<int>(std::get<std::int64_t>(value)); }
inline void assign(bool& field, const Value& value) { field = std::get<bool>(value); }
inline void assign(std::optional<bool>& field, const Value& value) { field = std::get<bool>(value); }
inline void assign(std::optional<Vec3>& field, const Value& value) { field = std::get<Vec3>(value); }
inline void assign(Vec3& field, const Value& value) { field = std::get<Vec3>(value); }
inline void assign(std::string& field, const Value& value) { field = std::get<std::string>(value); }
inline void assign(std::filesystem::path& field, const Value& value) { field = std::get<std::string>(value); }

inline Value value_of(double field) { return field; }
inline Value value_of(const std::optional<double>& field) { return field ? Value(*field) : Value(); }
inline Value value_of(const std::optional<bool>& field) { return field ? Value(*field) : Value(); }
inline Value value_of(const std::optional<Vec3>& field) { return field ? Value(*field) : Value(); }
inline Value value_of(std::int64_t field) { return field; }
inline Value value_of(int field) { return std::int64_t{field}; }
inline Value value_of(bool field) { return field; }
inline Value value_of(const Vec3& field) { return field; }
inline Value value_of(const std::string& field) { return field.empty() ? Value() : Value(field); }
inline Value value_of(const std::filesystem::path& field) { return value_of(field.string()); }

/// Access to place(config, element).*member; `place` takes a constant configuration too.
template <class Place, class Section, class Member>
Access field(Place place, Member Section::*member) {
  return {[=](const RunConfig& config, std::size_t element) { return value_of(place(config, element).*member); },
          [=](RunConfig& config, std::size_t element, const Value& value) {
            assign(place(config, element).*member, value);
          }};
}

/// Access to an enumeration; `words` are its enumerators in order.
template <class Place, class Section, class Enum>
Access choice(Place place, Enum Section::*member, const std::vector<std::string>& words) {
  return {[=](const RunConfig& config, std::size_t element) {
            return Value(words.at(static_cast<std::size_t>(place(config, element).*member)));
          },
          [=](RunConfig& config, std::size_t element, const Value& value) {
            const auto word = std::find(words.begin(), words.end(), std::get<std::string>(value));
            place(config, element).*member = static_cast<Enum>(word - words.begin());
          }};
}

/// Parses "[1 um, 10 m]"; the texts are ours, so a mistake in them asserts.
Range range(std::string_view text, Quantity quantity);

inline Fallback required() { return {Fallback::Kind::Required, "required", {}}; }
inline Fallback required_when(KeyCondition when) {
  std::string text = "required when " + when.text;
  return {Fallback::Kind::RequiredWhen, std::move(text), std::move(when)};
}
inline Fallback value(std::string text) { return {Fallback::Kind::Text, std::move(text), {}}; }
inline Fallback derived(std::string text) { return {Fallback::Kind::Derived, std::move(text), {}}; }
inline Fallback absent(std::string text) { return {Fallback::Kind::Absent, std::move(text), {}}; }

/// A number in SI or text with a unit.
inline Key quantity(std::string name, Quantity kind, std::string_view allowed, Fallback fallback, Access access,
                    std::string description) {
  return {.name = std::move(name),
          .type = KeyType::Quantity,
          .quantity = kind,
          .range = range(allowed, kind),
          .fallback = std::move(fallback),
          .description = std::move(description),
          .get = std::move(access.get),
          .set = std::move(access.set)};
}

/// Three quantities along x, y, z.
inline Key vector(std::string name, Quantity kind, std::string_view allowed, Fallback fallback, Access access,
                  std::string description) {
  Key key = quantity(std::move(name), kind, allowed, std::move(fallback), std::move(access), std::move(description));
  key.type = KeyType::Vector;
  return key;
}

inline Key integer(std::string name, std::string_view allowed, Fallback fallback, Access access,
                   std::string description) {
  Key key = quantity(std::move(name), Quantity::Ratio, allowed, std::move(fallback), std::move(access),
                     std::move(description));
  key.type = KeyType::Integer;
  return key;
}

/// Words, true or false, a file or a name: what has no range.
inline Key word(std::string name, KeyType type, std::vector<std::string> choices, Fallback fallback, Access access,
                std::string description) {
  return {.name = std::move(name),
          .type = type,
          .choices = std::move(choices),
          .fallback = std::move(fallback),
          .description = std::move(description),
          .get = std::move(access.get),
          .set = std::move(access.set)};
}

inline Key only_when(KeyCondition condition, Key key) {
  key.applies = std::move(condition);
  return key;
}

}  // namespace knap
