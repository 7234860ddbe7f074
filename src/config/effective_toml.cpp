#include <fmt/format.h>

#include "config/load_config.hpp"
#include "config/schema.hpp"

namespace knap {
namespace {

// A TOML basic string.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') out += '\\';
    if (code < 0x20 || code == 0x7F) {
      out += fmt::format("\\u{:04X}", code);
    } else {
      out += c;
    }
  }
  return out + "\"";
}

// The shortest text that gives the same double again; with a point even where it is whole, so that -0 keeps its sign.
std::string number(double x) {
  const std::string text = fmt::format("{}", x);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

struct Writer {
  std::string operator()(std::monostate) const { return ""; }
  std::string operator()(double x) const { return number(x); }
  std::string operator()(std::int64_t x) const { return std::to_string(x); }
  std::string operator()(bool x) const { return x ? "true" : "false"; }
  std::string operator()(const std::string& x) const { return quoted(x); }
  std::string operator()(const Vec3& x) const {
    return fmt::format("[{}, {}, {}]", number(x[0]), number(x[1]), number(x[2]));
  }
};

// A key that is not required may be unset, which is 0 in memory but not in its range.
bool is_unset(const Key& key, const Value& value) {
  using Kind = Fallback::Kind;
  const auto* number = std::get_if<double>(&value);
  const bool may_be_unset = key.fallback.kind == Kind::RequiredWhen || key.fallback.kind == Kind::Derived;
  return std::holds_alternative<std::monostate>(value) || (may_be_unset && number && *number == 0.0);
}

std::string unit_comment(const Key& key) {
  const bool has_unit = key.type == KeyType::Quantity || key.type == KeyType::Vector;
  return has_unit ? fmt::format("[{}] ", si_unit(key.quantity)) : "";
}

// One table of the file: the keys of a section for one element.
std::string table(const Section& section, const RunConfig& config, std::size_t element) {
  std::string text;
  for (const Key& key : schema()) {
    if (key.section != section.name || !applies(key, config, element)) continue;
    const Value value = key.get(config, element);
    if (!is_unset(key, value)) {
      text +=
          fmt::format("{} = {}  # {}{}\n", key.name, std::visit(Writer{}, value), unit_comment(key), key.description);
    } else if (key.fallback.kind == Fallback::Kind::Absent) {
      text += fmt::format("# {}: {}\n", key.name, key.fallback.text);
    }
  }
  return text;
}

// Brackets for what there may be many of only where there are; parts of several particles are each one's own.
std::string header(const Section& section, const RunConfig& config) {
  const bool several = section.scope == Scope::Tool || count(section.scope, config) > 1;
  if (section.is_part) return several ? fmt::format("[particle.{}]", section.name) : fmt::format("[{}]", section.name);
  return several ? fmt::format("[[{}]]", section.name) : fmt::format("[{}]", section.name);
}

}  // namespace

std::string effective_toml(const RunConfig& config) {
  std::string text = "# The complete case with every default resolved, in SI units. It can be run again.\n";
  for (std::size_t first = 0, last = 0; first < sections().size(); first = last) {
    const Scope scope = sections()[first].scope;
    while (last < sections().size() && sections()[last].scope == scope) ++last;
    for (std::size_t element = 0; element < count(scope, config); ++element)
      for (std::size_t i = first; i < last; ++i)
        text += "\n" + header(sections()[i], config) + "\n" + table(sections()[i], config, element);
  }
  return text;
}

}  // namespace knap
