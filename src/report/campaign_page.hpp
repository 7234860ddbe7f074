#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace knap {

/// A plot, shown as a picture in the page; nothing it refers to is loaded.
struct PageFigure {
  std::string title{};
  std::filesystem::path svg{};
  std::string caption{};
};

/// A line of a small table of results.
struct PageRow {
  std::string name{}, value{}, interval{}, remark{};
};

struct PageSection {
  std::string title{};
  std::vector<std::string> paragraphs{};
  std::vector<PageRow> rows{};
  std::vector<PageFigure> figures{};
};

/// A run to look at; its name is that in the table's first column.
struct PageRun {
  std::string name{};
  std::string caption{};
  std::filesystem::path picture{};  ///< PNG; left out where there is no such file
  std::filesystem::path frame{};    ///< its last .vtu, turned in 3-D; left out where there is no such file
  bool has_wall = true;             ///< the plane z = 0
};

/// Text as in results.csv: a column of numbers sorts as numbers, empty cells last.
struct PageTable {
  std::vector<std::string> columns{};
  std::vector<std::vector<std::string>> rows{};
  std::vector<std::string> first_shown{};  ///< columns shown at first; empty = run, state, what varies, some results
};

struct CampaignPage {
  std::string title{};
  std::string subtitle{};
  std::vector<std::string> verdicts{};  ///< plain sentences, first of all
  std::vector<PageSection> sections{};
  PageTable runs_table{};
  std::vector<PageRun> runs{};
};

/// Writes one HTML file that holds all it needs and loads nothing, in one step. All texts are UTF-8. Throws InputError
/// naming a figure, picture or frame that cannot be read, RuntimeFailure naming path and reason, std::invalid_argument
/// for a row of another length than the columns.
void write_campaign_page(const std::filesystem::path& html, const CampaignPage& page);

}  // namespace knap
