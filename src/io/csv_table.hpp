#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "io/posix_file.hpp"

namespace knap {

using CsvCell = std::variant<double, std::int64_t, std::string>;

/// A CSV file that grows by whole rows: each row is one write, so a killed run leaves readable complete lines. Numbers
/// are the shortest that read back to the same bits; in strings, line breaks become spaces.
class CsvTable {
 public:
  /// Starts a new file (replacing an old one) with column names that carry their units: "time [s]".
  static CsvTable create(const std::filesystem::path& path, std::vector<std::string> columns);
  /// Continues a file after its first `rows_to_keep` rows; later rows and a half-written line are cut off. Throws
  /// InputError if it has fewer complete rows.
  static CsvTable resume(const std::filesystem::path& path, std::size_t rows_to_keep);

  /// Appends a row of columns().size() cells. Throws RuntimeFailure naming path and reason; the rows before stay
  /// intact.
  void add_row(std::span<const CsvCell> cells);
  void add_row(std::initializer_list<CsvCell> cells) { add_row(std::span(cells.begin(), cells.size())); }

  const std::vector<std::string>& columns() const { return columns_; }
  std::size_t num_rows() const { return num_rows_; }

 private:
  CsvTable(std::filesystem::path path, PosixFile file) : path_(std::move(path)), file_(std::move(file)) {}
  void append_line(const std::string& line);

  std::filesystem::path path_;
  PosixFile file_;
  std::vector<std::string> columns_;
  std::size_t num_rows_ = 0;
  std::int64_t size_ = 0;  ///< of the complete lines [bytes]
};

/// The numbers of a CSV file; values[i] is the column named header[i].
struct CsvColumns {
  std::vector<std::string> header;
  std::vector<std::vector<double>> values;

  /// The column with this name. Throws InputError if there is none.
  const std::vector<double>& column(const std::string& name) const;
};

/// Reads a file of a header line and rows of numbers; blank lines and lines starting with # are skipped. Throws
/// InputError naming file and line for a missing file, a row of another length, a cell that is no number.
CsvColumns read_csv(const std::filesystem::path& path);

}  // namespace knap
