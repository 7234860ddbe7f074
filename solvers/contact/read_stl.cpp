#include "contact/read_stl.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>

#include "contact/repair_surface.hpp"
#include "core/errors.hpp"

namespace knap {
namespace {

constexpr std::size_t header_size = 80, record_size = 50;
using Soup = std::vector<std::array<Vec3, 3>>;

/// Words of an ASCII file, with the line they are in.
class WordCursor {
 public:
  WordCursor(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  std::string_view next() {
    skip_blanks();
    const std::size_t begin = place_;
    while (place_ < text_.size() && !is_blank(text_[place_])) ++place_;
    return text_.substr(begin, place_ - begin);
  }
  void skip_line() {
    while (place_ < text_.size() && text_[place_] != '\n') ++place_;
  }
  void expect(std::string_view word) {
    const std::string_view found = next();
    if (!same_word(found, word)) fail(fmt::format("'{}' where '{}' was expected", shown(found), word));
  }
  double number() {
    std::string_view word = next();
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
      fail(fmt::format("'{}' where a coordinate was expected", shown(word)));
    return value;
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}, line {}: {}", name_, line_, what));
  }
  static bool same_word(std::string_view a, std::string_view lower_case) {
    return std::equal(a.begin(), a.end(), lower_case.begin(), lower_case.end(),
                      [](char x, char y) { return (x >= 'A' && x <= 'Z' ? x - 'A' + 'a' : x) == y; });
  }
  /// A word for a message: short, printable.
  static std::string shown(std::string_view word) {
    std::string text(word.substr(0, 30));
    for (char& c : text)
      if (c < ' ' || c > '~') c = '?';
    return text;
  }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
  void skip_blanks() {
    for (; place_ < text_.size() && is_blank(text_[place_]); ++place_) line_ += text_[place_] == '\n' ? 1 : 0;
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t place_ = 0;
  std::size_t line_ = 1;
};

std::array<Vec3, 3> ascii_triangle(WordCursor& words, double scale) {
  words.expect("normal");
  for (int i = 0; i < 3; ++i) words.next();  // some writers put nan there
  words.expect("outer");
  words.expect("loop");
  std::array<Vec3, 3> triangle;
  for (Vec3& corner : triangle) {
    words.expect("vertex");
    for (double& x : corner) x = scale * words.number();
  }
  words.expect("endloop");
  words.expect("endfacet");
  return triangle;
}

Soup parse_ascii(std::string_view bytes, const std::string& name, double scale) {
  WordCursor words(bytes, name);
  Soup triangles;
  words.expect("solid");
  words.skip_line();
  for (bool inside = true;;) {
    const std::string_view word = words.next();
    if (word.empty()) {
      if (inside) words.fail("the file ends without 'endsolid'");
      return triangles;
    }
    if (inside && WordCursor::same_word(word, "facet")) {
      triangles.push_back(ascii_triangle(words, scale));
    } else if (WordCursor::same_word(word, inside ? "endsolid" : "solid")) {  // several solids make one tool
      words.skip_line();
      inside = !inside;
    } else {
      words.fail(fmt::format("'{}' where '{}' was expected", WordCursor::shown(word), inside ? "facet" : "solid"));
    }
  }
}

std::uint32_t binary_count(std::string_view bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + header_size, sizeof count);
  return count;
}

bool is_binary(std::string_view bytes) {
  return bytes.size() >= header_size + 4 &&
         bytes.size() == header_size + 4 + record_size * std::size_t{binary_count(bytes)};
}

Soup parse_binary(std::string_view bytes, const std::string& name, double scale) {
  Soup triangles(binary_count(bytes));
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    std::array<float, 12> numbers;  // the first three are the normal
    std::memcpy(numbers.data(), bytes.data() + header_size + 4 + record_size * t, sizeof numbers);
    for (std::size_t i = 0; i < 9; ++i) {
      if (!std::isfinite(numbers[3 + i]))
        throw InputError(fmt::format("{}: triangle {} has a coordinate that is no number", name, t + 1));
      triangles[t][i / 3][static_cast<Eigen::Index>(i % 3)] = scale * static_cast<double>(numbers[3 + i]);
    }
  }
  return triangles;
}

}  // namespace

std::vector<std::array<Vec3, 3>> parse_stl(std::string_view bytes, const std::string& name, double scale) {
  if (is_binary(bytes)) return parse_binary(bytes, name, scale);
  const std::size_t begin = bytes.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos) throw InputError(fmt::format("{}: the file is empty", name));
  if (WordCursor::same_word(bytes.substr(begin, 5), "solid")) return parse_ascii(bytes, name, scale);
  if (bytes.size() < header_size + 4)
    throw InputError(fmt::format("{}: this is no STL file: it does not begin with 'solid' and is too short", name));
  throw InputError(fmt::format(
      "{}: this is no STL file: it does not begin with 'solid', and a binary file of {} triangles, as it "
      "says, has {} bytes, not {}",
      name, binary_count(bytes), header_size + 4 + record_size * std::size_t{binary_count(bytes)}, bytes.size()));
}

TriangleSurface load_stl(const std::filesystem::path& path, double scale) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream bytes;
  if (!file || !(bytes << file.rdbuf()))
    throw InputError(fmt::format("cannot read '{}': is it there, and not empty?", path.string()));
  return repaired_surface(parse_stl(bytes.str(), path.string(), scale), path.string());
}

}  // namespace knap
