#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace knap {

/// The text as one CSV cell: quoted where it must be (RFC 4180), line breaks replaced by spaces.
std::string csv_quoted(std::string text);
/// The cells of one line, unquoted, spaces around them dropped. An unclosed quote ends with the line.
std::vector<std::string> csv_cells(std::string_view line);
/// The cells as column names. Throws InputError naming `place` if one is empty or a number.
std::vector<std::string> csv_header(const std::vector<std::string>& cells, const std::string& place);
/// The cell as a number, nan and inf included. Throws InputError naming `place`.
double csv_number(std::string_view cell, const std::string& place);

std::string_view trimmed(std::string_view text);
/// The whole file. Throws InputError if it cannot be read.
std::string read_text(const std::filesystem::path& path);

}  // namespace knap
