#pragma once
#include <string>
#include <string_view>

namespace knap {

inline constexpr std::size_t largest_case_file = 64 * 1024;  ///< [bytes]
inline constexpr std::size_t longest_line = 5000;            ///< [bytes]
inline constexpr std::size_t longest_path = 2000;            ///< [bytes]; fits into a line even when quotes double it

/// Why text must not reach the TOML parser, as "LINE: reason", or "" when it may. Besides text that is no text, this
/// stops what breaks toml11 3.7.1: deep nesting (unbounded recursion), keys added to an empty array (read of a missing
/// element), numbers in base 2, 8 and 16 (overflow), long lines and files (quadratic time, tables as deep as a dotted
/// key).
std::string reason_to_refuse(std::string_view text);

/// Whether text is valid UTF-8 on one line, without control characters.
bool is_plain_text(std::string_view text);

}  // namespace knap
