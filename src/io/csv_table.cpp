#include "io/csv_table.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>

#include "core/errors.hpp"
#include "io/csv_line.hpp"

namespace knap {
namespace {

struct WrittenCell {
  std::string operator()(double value) const { return fmt::format("{}", value); }
  std::string operator()(std::int64_t value) const { return fmt::format("{}", value); }
  std::string operator()(const std::string& text) const { return csv_quoted(text); }
};

std::string csv_line(std::span<const CsvCell> cells) {
  std::string line;
  for (const CsvCell& cell : cells) {
    line += std::visit(WrittenCell{}, cell);
    line += ',';
  }
  line.back() = '\n';
  return line;
}

}  // namespace

CsvTable CsvTable::create(const std::filesystem::path& path, std::vector<std::string> columns) {
  assert(!columns.empty());
  CsvTable table(path, open_file(path, O_WRONLY | O_CREAT | O_TRUNC | O_APPEND));
  table.append_line(csv_line(std::vector<CsvCell>(columns.begin(), columns.end())));
  table.columns_ = std::move(columns);
  return table;
}

CsvTable CsvTable::resume(const std::filesystem::path& path, std::size_t rows_to_keep) {
  const std::string text = read_text(path);
  std::size_t end = 0;
  std::size_t lines = 0;
  std::string_view header;
  for (; lines < rows_to_keep + 1; ++lines) {
    const std::size_t next = text.find('\n', end);
    if (next == std::string::npos) break;
    if (lines == 0) header = std::string_view(text).substr(0, next);
    end = next + 1;
  }
  if (lines < rows_to_keep + 1) {
    throw InputError(fmt::format("{}: cannot resume after {} rows: it has {} complete lines, header included",
                                 path.string(), rows_to_keep, lines));
  }
  CsvTable table(path, open_file(path, O_WRONLY | O_APPEND));
  table.columns_ = csv_cells(header);
  table.num_rows_ = rows_to_keep;
  table.size_ = static_cast<std::int64_t>(end);
  if (::ftruncate(table.file_.descriptor(), table.size_) != 0) throw_file_error(path, "cut");
  return table;
}

void CsvTable::add_row(std::span<const CsvCell> cells) {
  assert(cells.size() == columns_.size());
  append_line(csv_line(cells));
  ++num_rows_;
}

void CsvTable::append_line(const std::string& line) {
  try {
    write_all(file_, line, path_);
  } catch (const RuntimeFailure&) {
    // A full disk may have taken half of the line. If the cut fails too, the first failure is the one to report.
    [[maybe_unused]] const int cut = ::ftruncate(file_.descriptor(), size_);
    throw;
  }
  size_ += static_cast<std::int64_t>(line.size());
}

const std::vector<double>& CsvColumns::column(const std::string& name) const {
  const auto found = std::find(header.begin(), header.end(), name);
  if (found == header.end()) {
    const std::string nearest = nearest_name(name, header);
    throw InputError(
        fmt::format("no CSV column '{}'{}", name, nearest.empty() ? "" : ", nearest is '" + nearest + "'"));
  }
  return values[static_cast<std::size_t>(found - header.begin())];
}

CsvColumns read_csv(const std::filesystem::path& path) {
  const std::string text = read_text(path);
  const std::size_t start = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;  // the mark spreadsheets put in front
  CsvColumns table;
  std::size_t line_number = 0;
  for (std::size_t begin = start; begin < text.size(); ++line_number) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = trimmed(std::string_view(text).substr(begin, end - begin));
    begin = end + 1;
    if (line.empty() || line.front() == '#') continue;
    const std::string place = fmt::format("{}:{}", path.string(), line_number + 1);
    const std::vector<std::string> cells = csv_cells(line);
    if (table.header.empty()) {
      table.header = csv_header(cells, place);
      table.values.resize(cells.size());
      continue;
    }
    if (cells.size() != table.header.size()) {
      throw InputError(fmt::format("{}: {} cells, the header has {}", place, cells.size(), table.header.size()));
    }
    for (std::size_t i = 0; i < cells.size(); ++i) table.values[i].push_back(csv_number(cells[i], place));
  }
  if (table.header.empty()) throw InputError(fmt::format("{}: no header line", path.string()));
  return table;
}

}  // namespace knap
