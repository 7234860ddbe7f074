#include "config/units.hpp"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>

#include "core/errors.hpp"

namespace knap {
namespace {

// Twice the SI exponents, so that the square root in a fracture toughness stays an integer.
struct Dimension {
  int length = 0, mass = 0, time = 0, angle = 0;
  bool operator==(const Dimension&) const = default;
};

struct QuantityRow {
  std::string_view name, si_unit, sample_units, sample_value;
  Dimension dimension;
};

// In the order of enum Quantity.
constexpr std::array<QuantityRow, static_cast<std::size_t>(Quantity::Count)> quantities{{
    {"a ratio", "-", "%", "0.3", {}},
    {"a length", "m", "m, cm, mm, um", "2 mm", {2, 0, 0, 0}},
    {"a volume", "m3", "m3, cm3, mm3", "1 mm3", {6, 0, 0, 0}},
    {"a time", "s", "s, ms, us, ns, min", "20 us", {0, 0, 2, 0}},
    {"a speed", "m/s", "m/s, mm/s, km/s, km/h", "15 m/s", {2, 0, -2, 0}},
    {"an angle", "rad", "deg, rad", "60 deg", {0, 0, 0, 2}},
    {"an angular speed", "rad/s", "rad/s, deg/s, rpm", "100 rad/s", {0, 0, -2, 2}},
    {"a stress", "Pa", "Pa, kPa, MPa, GPa", "2.45 GPa", {-2, 2, -4, 0}},
    {"a density", "kg/m3", "kg/m3, g/cm3", "1270 kg/m3", {-6, 2, 0, 0}},
    {"an energy per area", "J/m2", "J/m2, N/m, mJ/mm2", "8.6 J/m2", {0, 2, -4, 0}},
    {"a fracture toughness", "Pa m^1/2", "Pa m^1/2, kPa m^1/2, MPa m^1/2", "0.2 MPa m^1/2", {-1, 2, -4, 0}},
    {"a mass", "kg", "kg, g, mg", "5 g", {0, 2, 0, 0}},
    {"an acceleration", "m/s2", "m/s2, mm/s2", "9.81 m/s2", {2, 0, -4, 0}},
}};

const QuantityRow& row(Quantity quantity) { return quantities[static_cast<std::size_t>(quantity)]; }

// A unit is factor * 10^power10 of SI.
struct UnitSymbol {
  std::string_view symbol;
  bool takes_prefix;
  double factor;
  int power10;
  Dimension dimension;
};

constexpr std::string_view middle_dot = "\u00b7";
constexpr double pi = std::numbers::pi;
constexpr std::array<UnitSymbol, 13> unit_symbols{{
    {"m", true, 1.0, 0, {2, 0, 0, 0}},
    {"g", true, 1.0, -3, {0, 2, 0, 0}},
    {"s", true, 1.0, 0, {0, 0, 2, 0}},
    {"min", false, 60.0, 0, {0, 0, 2, 0}},
    {"h", false, 3600.0, 0, {0, 0, 2, 0}},
    {"rad", true, 1.0, 0, {0, 0, 0, 2}},
    {"deg", false, pi / 180.0, 0, {0, 0, 0, 2}},
    {"\u00b0", false, pi / 180.0, 0, {0, 0, 0, 2}},
    {"rpm", false, pi / 30.0, 0, {0, 0, -2, 2}},
    {"N", true, 1.0, 0, {2, 2, -4, 0}},
    {"Pa", true, 1.0, 0, {-2, 2, -4, 0}},
    {"J", true, 1.0, 0, {4, 2, -4, 0}},
    {"%", false, 1.0, -2, {}},
}};

struct Prefix {
  std::string_view symbol;
  int power10;
};
constexpr std::array<Prefix, 12> prefixes{{{"p", -12},
                                           {"n", -9},
                                           {"u", -6},
                                           {"\u00b5", -6},
                                           {"\u03bc", -6},
                                           {"m", -3},
                                           {"c", -2},
                                           {"d", -1},
                                           {"k", 3},
                                           {"M", 6},
                                           {"G", 9},
                                           {"T", 12}}};

// A product of units; powers are counted in halves.
struct Unit {
  double factor = 1.0;
  int half_power10 = 0;
  Dimension dimension;
};

void multiply(Unit& unit, const UnitSymbol& by, int prefix_power10, int half_exponent) {
  if (by.factor != 1.0) unit.factor *= std::pow(by.factor, half_exponent / 2.0);
  unit.half_power10 += (by.power10 + prefix_power10) * half_exponent;
  unit.dimension.length += by.dimension.length * half_exponent / 2;
  unit.dimension.mass += by.dimension.mass * half_exponent / 2;
  unit.dimension.time += by.dimension.time * half_exponent / 2;
  unit.dimension.angle += by.dimension.angle * half_exponent / 2;
}

bool multiply_by_name(Unit& unit, std::string_view symbol, int half_exponent) {
  for (const auto& known : unit_symbols)
    if (symbol == known.symbol) return multiply(unit, known, 0, half_exponent), true;
  for (const auto& prefix : prefixes) {
    if (!symbol.starts_with(prefix.symbol)) continue;
    for (const auto& known : unit_symbols)
      if (known.takes_prefix && symbol.substr(prefix.symbol.size()) == known.symbol)
        return multiply(unit, known, prefix.power10, half_exponent), true;
  }
  return false;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '%' || (c & 0x80) != 0; }

bool take(std::string_view& text, std::string_view start) {
  if (!text.starts_with(start)) return false;
  text.remove_prefix(start.size());
  return true;
}

// Reads "2", "^-2", "^1/2", "^(1/2)" or "^0.5" as a number of halves; 2 (one) when nothing follows the symbol.
std::optional<int> take_half_exponent(std::string_view& text) {
  const bool caret = take(text, "^");
  const bool bracket = caret && take(text, "(");
  const int sign = take(text, "-") ? -1 : 1;
  if (text.empty() || !is_digit(text.front())) return caret || sign < 0 ? std::nullopt : std::optional<int>(2);
  int halves = 2 * (text.front() - '0');
  text.remove_prefix(1);
  if (caret && take(text, "/2")) halves /= 2;
  if (caret && take(text, ".5")) halves += 1;
  if (bracket && !take(text, ")")) return std::nullopt;
  if (!text.empty() && is_digit(text.front())) return std::nullopt;
  return sign * halves;
}

// Reads one factor such as "mm3", "m^1/2" or "sqrt(m)" into `unit`; false when it is no unit.
bool take_factor(std::string_view& text, int sign, Unit& unit) {
  const bool root = take(text, "sqrt(");
  std::size_t length = 0;
  while (length < text.size() && is_letter(text[length]) && !text.substr(length).starts_with(middle_dot)) ++length;
  const std::string_view symbol = text.substr(0, length);
  text.remove_prefix(length);
  const auto halves = root ? std::optional<int>(1) : take_half_exponent(text);
  if (root && !take(text, ")")) return false;
  return halves && multiply_by_name(unit, symbol, sign * *halves);
}

std::optional<Unit> parse_unit(std::string_view text) {
  Unit unit;
  int sign = 1;
  for (int factors = 0; !text.empty(); ++factors) {
    if (factors == 8 || !take_factor(text, sign, unit)) return std::nullopt;
    sign = 1;
    const bool space = take(text, " ");
    while (take(text, " ")) {
    }
    if (take(text, "/")) {
      sign = -1;
    } else if (!take(text, "*") && !take(text, middle_dot) && !space && !text.empty()) {
      return std::nullopt;
    }
    while (take(text, " ")) {
    }
    if (text.empty() && sign < 0) return std::nullopt;
  }
  return unit;
}

// Length of the decimal number at the start of text; 0 = none.
std::size_t number_length(std::string_view text) {
  double ignored = 0.0;
  const std::size_t sign = !text.empty() && (text[0] == '+' || text[0] == '-') ? 1 : 0;
  const std::string_view digits = text.substr(sign);
  if (digits.empty() || (!is_digit(digits[0]) && digits[0] != '.')) return 0;
  const auto end = std::from_chars(digits.data(), digits.data() + digits.size(), ignored);
  return end.ec == std::errc::invalid_argument ? 0 : sign + static_cast<std::size_t>(end.ptr - digits.data());
}

// The decimal number times 10^shift, correctly rounded.
std::optional<double> shifted_decimal(std::string_view number, int shift) {
  take(number, "+");
  const std::size_t e = number.find_first_of("eE");
  std::int64_t exponent = 0;
  if (e != std::string_view::npos) {
    std::string_view digits = number.substr(e + 1);
    take(digits, "+");
    if (std::from_chars(digits.data(), digits.data() + digits.size(), exponent).ec != std::errc{}) return std::nullopt;
    if (std::abs(exponent) > 100000) return std::nullopt;
  }
  const std::string moved = fmt::format("{}e{}", number.substr(0, e), exponent + shift);
  double value = 0.0;
  if (std::from_chars(moved.data(), moved.data() + moved.size(), value).ec != std::errc{}) return std::nullopt;
  return value;
}

std::optional<double> to_si(std::string_view number, const Unit& unit) {
  const bool odd = unit.half_power10 % 2 != 0;
  const auto decimal = shifted_decimal(number, (unit.half_power10 - (odd ? 1 : 0)) / 2);
  if (!decimal) return std::nullopt;
  const double value = *decimal * (odd ? std::sqrt(10.0) : 1.0) * unit.factor;
  return std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

std::string expectation(Quantity expected) {
  return fmt::format("expected {}, such as \"{}\" (units: {})", name(expected), sample_value(expected),
                     sample_units(expected));
}

std::string unknown_unit(std::string_view unit, Quantity expected) {
  if (unit.size() > 1 && unit[0] == ',' && std::isdigit(static_cast<unsigned char>(unit[1])))
    return fmt::format("has a decimal comma, write a point; {}", expectation(expected));
  std::vector<std::string> candidates;
  std::string_view rest = sample_units(expected);
  while (!rest.empty()) {
    const std::size_t comma = rest.find(", ");
    candidates.emplace_back(rest.substr(0, comma));
    rest = comma == std::string_view::npos ? "" : rest.substr(comma + 2);
  }
  const std::string shown(unit.substr(0, 24));
  const std::string nearest = nearest_name(shown, candidates);
  return fmt::format("unknown unit \"{}\"{}; {}", shown,
                     nearest.empty() ? "" : fmt::format(", did you mean \"{}\"?", nearest), expectation(expected));
}

std::string wrong_dimension(const Dimension& found, std::string_view unit, Quantity expected) {
  for (const auto& known : quantities)
    if (known.dimension == found && !unit.empty())
      return fmt::format("\"{}\" measures {}; {}", unit, known.name, expectation(expected));
  return fmt::format("{}; {}", unit.empty() ? "the unit is missing" : fmt::format("\"{}\" does not fit", unit),
                     expectation(expected));
}

}  // namespace

std::string_view name(Quantity quantity) { return row(quantity).name; }
std::string_view si_unit(Quantity quantity) { return row(quantity).si_unit; }
std::string_view sample_units(Quantity quantity) { return row(quantity).sample_units; }
std::string_view sample_value(Quantity quantity) { return row(quantity).sample_value; }

Conversion convert_to_si(std::string_view text, Quantity expected) {
  text = trimmed(text);
  const std::size_t length = number_length(text);
  if (length == 0) return {0.0, "does not start with a number; " + expectation(expected)};
  const std::string_view unit_text = trimmed(text.substr(length));
  const auto unit = parse_unit(unit_text);
  if (!unit) return {0.0, unknown_unit(unit_text, expected)};
  if (unit->dimension != row(expected).dimension) {
    return {0.0, wrong_dimension(unit->dimension, unit_text.substr(0, 24), expected)};
  }
  const auto value = to_si(text.substr(0, length), *unit);
  if (!value) return {0.0, "is too large or too small for a number"};
  return {*value, ""};
}

}  // namespace knap
