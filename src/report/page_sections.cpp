#include "report/page_sections.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/errors.hpp"
#include "io/csv_line.hpp"
#include "io/markup.hpp"
#include "report/page_text.hpp"

namespace knap {
namespace {

bool is_there(const std::filesystem::path& path) {
  std::error_code ignored;
  return !path.empty() && std::filesystem::exists(path, ignored);
}

std::string picture_html(const std::filesystem::path& file, std::string_view type, const std::string& text) {
  return fmt::format(
      "<button class=\"enlarge\" type=\"button\" aria-label=\"Enlarge: {0}\"><img loading=\"lazy\" alt=\"{0}\" "
      "src=\"{1}\"></button>",
      markup_escaped(text), data_url(type, read_text(file)));
}

std::string figure_html(const PageFigure& figure) {
  // As an <img>, not inline: ids of several plots cannot meet, and nothing in an SVG can run or load.
  const std::string svg = picture_html(figure.svg, "image/svg+xml", figure.title);
  return fmt::format(
      "<figure class=\"plot\">\n<h3>{}</h3>\n{}\n<figcaption><span>{}</span> <a class=\"save\" download=\"{}\" "
      "href=\"#\">SVG</a></figcaption>\n</figure>\n",
      markup_escaped(figure.title), svg, markup_escaped(figure.caption),
      markup_escaped(figure.svg.filename().string()));
}

// Columns that no row uses are left out.
std::string rows_html(const std::vector<PageRow>& rows) {
  if (rows.empty()) return "";
  const auto used = [&](auto member) {
    return std::any_of(rows.begin(), rows.end(), [&](const PageRow& row) { return !(row.*member).empty(); });
  };
  const bool has_interval = used(&PageRow::interval), has_remark = used(&PageRow::remark);
  std::string html =
      "<div class=\"scroll\"><table class=\"results\">\n<thead><tr><th scope=\"col\">Quantity</th><th "
      "scope=\"col\">Value</th>";
  if (has_interval) html += "<th scope=\"col\">Interval</th>";
  if (has_remark) html += "<th scope=\"col\">Remark</th>";
  html += "</tr></thead>\n<tbody>\n";
  for (const PageRow& row : rows) {
    html += fmt::format("<tr><th scope=\"row\">{}</th><td class=\"value\">{}</td>", markup_escaped(row.name),
                        markup_escaped(row.value));
    if (has_interval) html += fmt::format("<td class=\"interval\">{}</td>", markup_escaped(row.interval));
    if (has_remark) html += fmt::format("<td class=\"remark\">{}</td>", markup_escaped(row.remark));
    html += "</tr>\n";
  }
  return html + "</tbody>\n</table></div>\n";
}

std::string section_html(const PageSection& section, std::size_t number) {
  std::string html = fmt::format("<section id=\"section-{}\">\n<h2>{}</h2>\n", number, markup_escaped(section.title));
  for (const std::string& paragraph : section.paragraphs) html += fmt::format("<p>{}</p>\n", markup_escaped(paragraph));
  html += rows_html(section.rows);
  if (!section.figures.empty()) {
    html += "<div class=\"plots\">\n";
    for (const PageFigure& figure : section.figures) html += figure_html(figure);
    html += "</div>\n";
  }
  return html + "</section>\n";
}

std::string link_html(const std::string& id, const std::string& text) {
  return fmt::format("<li><a href=\"#{}\">{}</a></li>\n", id, markup_escaped(text));
}

}  // namespace

bool has_picture(const PageRun& run) { return is_there(run.picture); }
bool has_frame(const PageRun& run) { return is_there(run.frame); }

std::string verdicts_html(const CampaignPage& page) {
  if (page.verdicts.empty()) return "";
  std::string html = "<ul class=\"verdicts\">\n";
  for (const std::string& verdict : page.verdicts) html += fmt::format("<li>{}</li>\n", markup_escaped(verdict));
  return html + "</ul>\n";
}

std::string contents_html(const CampaignPage& page) {
  std::string html = "<ol>\n";
  for (std::size_t i = 0; i < page.sections.size(); ++i)
    html += link_html(fmt::format("section-{}", i + 1), page.sections[i].title);
  if (std::any_of(page.runs.begin(), page.runs.end(), has_frame)) html += link_html("fragments", "Fragments in 3-D");
  if (std::any_of(page.runs.begin(), page.runs.end(), has_picture)) html += link_html("pictures", "Pictures");
  return html + link_html("runs", "All runs") + "</ol>\n";
}

std::string sections_html(const CampaignPage& page) {
  std::string html;
  for (std::size_t i = 0; i < page.sections.size(); ++i) html += section_html(page.sections[i], i + 1);
  return html;
}

std::string gallery_html(const CampaignPage& page) {
  std::string html;
  for (const PageRun& run : page.runs) {
    if (!has_picture(run)) continue;
    html += fmt::format("<figure class=\"picture\">\n{}\n<figcaption><strong>{}</strong> {}</figcaption>\n</figure>\n",
                        picture_html(run.picture, "image/png", run.name), markup_escaped(run.name),
                        markup_escaped(run.caption));
  }
  if (html.empty()) return "";
  return "<section id=\"pictures\" class=\"wide\">\n<h2>Pictures</h2>\n<div class=\"gallery\">\n" + html +
         "</div>\n</section>\n";
}

}  // namespace knap
