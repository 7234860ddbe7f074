#include "config/toml_guard.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace knap {
namespace {

constexpr int deepest_nesting = 16;

std::string refusal(std::string_view text, std::size_t where, std::string_view reason) {
  const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(where), '\n');
  return fmt::format("{}: {}", line, reason);
}

// Number of bytes of the UTF-8 character at `at`; 0 = not valid.
std::size_t character_length(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(i < text.size() ? text[i] : '\0'); };
  const unsigned char first = byte(at);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(at + i) & 0xC0) != 0x80) return 0;
  const unsigned char second = byte(at + 1);
  const bool overlong = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
  const bool outside = (first == 0xED && second > 0x9F) || (first == 0xF4 && second > 0x8F);
  return overlong || outside ? 0 : length;
}

std::string not_text(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    if (text[at] == '\0') return refusal(text, at, "a zero byte: this is a binary file, not a case file");
    const std::size_t length = character_length(text, at);
    if (length == 0) return refusal(text, at, "not UTF-8 text");
    at += length;
  }
  return "";
}

std::string long_line(std::string_view text) {
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    if (end - start > longest_line)
      return refusal(text, start, fmt::format("more than {} bytes in a line", longest_line));
    start = end + 1;
  }
  return "";
}

// One past the end of the string literal that starts at `at`.
std::size_t end_of_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const std::string_view triple = quote == '"' ? "\"\"\"" : "'''";
  const bool many_lines = text.substr(at).starts_with(triple);
  std::size_t i = at + (many_lines ? 3 : 1);
  while (i < text.size()) {
    if (quote == '"' && text[i] == '\\') {
      i += 2;
    } else if (many_lines && text.substr(i).starts_with(triple)) {
      i += 3;
      while (i < text.size() && text[i] == quote) ++i;
      return i;
    } else if (!many_lines && (text[i] == quote || text[i] == '\n')) {
      return i + 1;
    } else {
      ++i;
    }
  }
  return text.size();
}

// The text with strings and comments blanked, same length and lines: only the structure is left.
std::string skeleton(std::string_view text) {
  std::string bare(text);
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = at + 1;
    char blank = bare[at];
    if (text[at] == '#') {
      end = std::min(text.find('\n', at), text.size());
      blank = ' ';
    } else if (text[at] == '"' || text[at] == '\'') {
      end = std::min(end_of_string(text, at), text.size());
      blank = 's';
    }
    for (std::size_t i = at; i < end; ++i)
      if (bare[i] != '\n') bare[i] = blank;
    at = end;
  }
  return bare;
}

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

std::string bad_nesting(std::string_view bare) {
  int depth = 0;
  for (std::size_t i = 0; i < bare.size(); ++i) {
    if (bare[i] == ']' || bare[i] == '}') depth = std::max(depth - 1, 0);
    if (bare[i] != '[' && bare[i] != '{') continue;
    if (++depth > deepest_nesting) return refusal(bare, i, "brackets are nested too deeply");
    std::size_t next = i + 1;
    while (next < bare.size() && is_space(bare[next])) ++next;
    if (bare[i] == '[' && next < bare.size() && bare[next] == ']') return refusal(bare, i, "empty brackets []");
  }
  return "";
}

std::string bad_number(std::string_view bare) {
  constexpr std::string_view before_a_value = " \t\n\r=,[{+-";
  for (std::size_t i = 1; i + 1 < bare.size(); ++i) {
    const char base = bare[i + 1];
    if (bare[i] == '0' && (base == 'x' || base == 'o' || base == 'b') &&
        before_a_value.find(bare[i - 1]) != std::string_view::npos) {
      return refusal(bare, i, "only decimal numbers are allowed");
    }
  }
  return "";
}

}  // namespace

std::string reason_to_refuse(std::string_view text) {
  if (text.size() > largest_case_file) return fmt::format("1: more than {} KiB", largest_case_file / 1024);
  if (const std::string reason = not_text(text); !reason.empty()) return reason;
  if (const std::string reason = long_line(text); !reason.empty()) return reason;
  const std::string bare = skeleton(text);
  if (const std::string reason = bad_nesting(bare); !reason.empty()) return reason;
  return bad_number(bare);
}

bool is_plain_text(std::string_view text) {
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; };
  return not_text(text).empty() && std::none_of(text.begin(), text.end(), is_control);
}

}  // namespace knap
