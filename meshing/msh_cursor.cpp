#include "meshing/msh_cursor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/errors.hpp"

namespace knap {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
bool is_space(char c) { return is_blank(c) || c == '\n'; }

// What the file says, fit for a terminal.
std::string shown(std::string_view text) {
  std::string result(text.substr(0, 40));
  for (char& c : result)
    if (c < ' ' || c > '~') c = '?';
  return result;
}

template <class Number>
bool parse(std::string_view text, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

void MshCursor::fail(std::size_t offset, const std::string& message) const {
  if (is_binary) throw InputError(fmt::format("{}: byte {}: {}", file_, offset, message));
  const auto end = bytes_.begin() + static_cast<std::ptrdiff_t>(std::min(offset, bytes_.size()));
  throw InputError(fmt::format("{}:{}: {}", file_, 1 + std::count(bytes_.begin(), end, '\n'), message));
}

std::size_t MshCursor::offset() {
  if (!is_binary) at_end();
  return offset_;
}

bool MshCursor::at_end() {
  while (offset_ < bytes_.size() && is_space(bytes_[offset_])) ++offset_;
  return offset_ == bytes_.size();
}

std::string_view MshCursor::line() {
  const std::size_t begin = offset_;
  std::size_t end = std::min(bytes_.find('\n', begin), bytes_.size());
  offset_ = std::min(end + 1, bytes_.size());
  while (end > begin && is_blank(bytes_[end - 1])) --end;
  return bytes_.substr(begin, end - begin);
}

void MshCursor::expect_line(std::string_view expected) {
  const bool ended = at_end();
  const std::size_t begin = offset_;
  const std::string_view found = line();
  if (found != expected)
    fail(begin, fmt::format("expected {}, found {}", expected, ended ? "the end of the file" : shown(found)));
}

void MshCursor::skip_past_line(const std::string& end) {
  const std::size_t begin = offset_;
  for (std::size_t found = bytes_.find(end, begin); found != std::string_view::npos;
       found = bytes_.find(end, found + 1)) {
    const std::size_t after = found + end.size();
    if (bytes_[found - 1] != '\n' || (after < bytes_.size() && !is_space(bytes_[after]))) continue;
    offset_ = after;
    return;
  }
  fail(begin, fmt::format("no {} follows", end));
}

std::string_view MshCursor::word(const char* what) {
  if (at_end()) fail(offset_, fmt::format("the file ends where {} was expected", what));
  const std::size_t begin = offset_;
  while (offset_ < bytes_.size() && !is_space(bytes_[offset_])) ++offset_;
  return bytes_.substr(begin, offset_ - begin);
}

std::int64_t MshCursor::text_integer(const char* what) {
  const std::string_view text = word(what);
  std::int64_t value = 0;
  if (!parse(text, value)) fail(offset_ - text.size(), fmt::format("expected {}, found {}", what, shown(text)));
  return value;
}

template <class T>
T MshCursor::raw(const char* what) {
  if (bytes_.size() - offset_ < sizeof(T)) fail(offset_, fmt::format("the file ends where {} was expected", what));
  T value;
  std::memcpy(&value, bytes_.data() + offset_, sizeof(T));
  offset_ += sizeof(T);
  return value;
}

std::int64_t MshCursor::int32(const char* what) {
  if (is_binary) return raw<std::int32_t>(what);
  const std::int64_t value = text_integer(what);
  using Limits = std::numeric_limits<std::int32_t>;
  if (value < Limits::min() || value > Limits::max()) fail(offset_, fmt::format("{} is {}, out of range", what, value));
  return value;
}

std::int64_t MshCursor::size(const char* what) {
  const std::int64_t value = is_binary ? raw<std::int64_t>(what) : text_integer(what);
  if (value < 0) fail(offset_, fmt::format("{} is {}, out of range", what, value));
  return value;
}

double MshCursor::real(const char* what) {
  double value = 0.0;
  if (is_binary) {
    value = raw<double>(what);
  } else {
    const std::string_view text = word(what);
    if (!parse(text, value)) fail(offset_ - text.size(), fmt::format("expected {}, found {}", what, shown(text)));
  }
  if (!std::isfinite(value)) fail(offset_, fmt::format("{} is not finite", what));
  return value;
}

}  // namespace knap
