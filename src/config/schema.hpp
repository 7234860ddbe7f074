#pragma once
// The one table of keys: reading, checks, defaults, effective.toml, `knap keys` and docs/case_reference.md all come
// from it, so that a new key is one new row and cannot be forgotten in one of them.
//
// Particles and tools are lists. A row is reached with the number of the element it is asked for; the scope of its
// section says which list that counts, so a row of [[tool]] is written like any other. The alternative, a second kind
// of table for lists, would double everything that reads the table.
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "config/run_config.hpp"
#include "config/units.hpp"

namespace knap {

/// A checked value in SI; monostate = absent. A choice is the chosen word, a file its path.
using Value = std::variant<std::monostate, double, std::int64_t, bool, std::string, Vec3>;

/// A Name is a word of the user's choice.
enum class KeyType { Quantity, Vector, Integer, Switch, Choice, File, Name };

/// What a section describes: the case, or one of a list of things.
enum class Scope { Case, Particle, Tool };

struct Section {
  std::string name;
  Scope scope = Scope::Case;
  bool is_part = false;  ///< of a particle: written [particle.NAME], or [NAME] for all particles
  std::string note;      ///< how it is written, for the case reference
};

/// Every section, in the order in which they are written; those of one scope follow each other.
const std::vector<Section>& sections();
const Section* find_section(std::string_view name);

/// How many things of that scope a case has.
std::size_t count(Scope scope, const RunConfig& config);

/// An interval in SI, written as "[1 um, 10 m]"; a round bracket excludes its end.
struct Range {
  double low = 0.0;
  double high = 0.0;
  bool low_open = false;
  bool high_open = false;
  std::string text;
};

/// When a key has a meaning, or must be given.
struct KeyCondition {
  std::string text;  ///< "shape = \"sphere\""; "" = always
  std::function<bool(const RunConfig&, std::size_t)> holds;
};

/// What stands in for a key that is not given.
struct Fallback {
  enum class Kind {
    Required,      ///< nothing: it must be given, by the case or its preset
    RequiredWhen,  ///< it must be given when `when` holds
    Text,          ///< `text`, as it could stand in a case file
    Derived,       ///< computed from other keys, see derived_values.hpp
    Absent         ///< the program decides while running
  };
  Kind kind = Kind::Required;
  std::string text;  ///< the value, or a few words on where it comes from
  KeyCondition when{};
};

struct Key {
  std::string section{}, name{};
  KeyType type = KeyType::Quantity;
  Quantity quantity = Quantity::Ratio;
  std::vector<std::string> choices{};
  Range range{};
  Fallback fallback{};
  KeyCondition applies{};
  std::string description{};
  std::function<Value(const RunConfig&, std::size_t)> get{};  ///< of that element; 0 for the case
  std::function<void(RunConfig&, std::size_t, const Value&)> set{};
};

/// Every key, by section, in the order in which they are written.
const std::vector<Key>& schema();

/// The key [section] name, or nullptr.
const Key* find_key(std::string_view section, std::string_view name);

/// The sections' names, in order.
std::vector<std::string> section_names();

/// The keys of a section in order.
std::vector<std::string> key_names(std::string_view section);

/// What a key's section describes.
Scope scope(const Key& key);

/// Whether a case must give this key (unless its preset does) for that element.
bool is_required(const Key& key, const RunConfig& config, std::size_t element);
bool applies(const Key& key, const RunConfig& config, std::size_t element);

/// "from 1 um to 10 m", "above 0 deg up to 90 deg".
std::string in_words(const Range& range);

/// All keys as an aligned table, for `knap keys`.
std::string describe_keys();

/// The page docs/case_reference.md.
std::string keys_as_markdown();

}  // namespace knap
