#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace knap {

/// Reads a .msh file's bytes from front to back, numbers as text or in binary. Every reader throws InputError, with the
/// file's name and the line (ASCII) or byte (binary), when the bytes are not there or not what was expected. Nothing is
/// ever allocated by a count found in the file.
class MshCursor {
 public:
  MshCursor(std::string_view bytes, std::string file) : bytes_(bytes), file_(std::move(file)) {}

  bool is_binary = false;  ///< how int32, size and real read; known once $MeshFormat is read

  /// Where the next number or line starts.
  std::size_t offset();
  /// Throws InputError about what starts at `offset`.
  [[noreturn]] void fail(std::size_t offset, const std::string& message) const;

  /// Skips blanks and empty lines; true at the end of the file.
  bool at_end();
  /// The rest of the line, without line end and trailing blanks.
  std::string_view line();
  /// A line that must read `expected`, blank lines before it skipped.
  void expect_line(std::string_view expected);
  /// Skips to after the line that reads `end`, e.g. "$EndPeriodic".
  void skip_past_line(const std::string& end);

  std::int64_t text_integer(const char* what);
  std::int64_t int32(const char* what);
  std::int64_t size(const char* what);  ///< 64 bits, not negative
  double real(const char* what);        ///< finite

 private:
  std::string_view word(const char* what);
  template <class T>
  T raw(const char* what);

  std::string_view bytes_;
  std::string file_;
  std::size_t offset_ = 0;
};

}  // namespace knap
