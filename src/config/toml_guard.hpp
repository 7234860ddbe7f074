#pragma once
#include <string>
#include <string_view>

namespace knap {

inline constexpr std::size_t largest_case_file = 64 * 1024;  ///< [bytes]

/// Why text must not reach the TOML parser, as "LINE: reason", or "" when it may. Besides text that is no text, this
/// stops what breaks toml11 3.7.1: deep nesting (unbounded recursion), keys added to an empty array (read of a missing
/// element), numbers in base 2, 8 and 16 (overflow), long files (quadratic time).
std::string reason_to_refuse(std::string_view text);

/// Whether text is valid UTF-8 without zero bytes.
bool is_utf8_text(std::string_view text);

}  // namespace knap
