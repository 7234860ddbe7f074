#include "report/page_data.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "report/packed_surfaces.hpp"
#include "report/page_sections.hpp"
#include "report/page_text.hpp"

namespace knap {
namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Json& json) { return script_safe(json.dump(-1, ' ', false, Json::error_handler_t::replace)); }

}  // namespace

std::string table_json(const PageTable& table) {
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    if (table.rows[i].size() != table.columns.size())
      throw std::invalid_argument(fmt::format("page's table: row {} has {} cells for {} columns", i,
                                              table.rows[i].size(), table.columns.size()));
  return text_of({{"columns", table.columns}, {"rows", table.rows}, {"shown", table.first_shown}});
}

std::string frames_html(const CampaignPage& page) {
  Json frames = Json::array();
  std::string html;
  for (const PageRun& run : page.runs) {
    if (!has_frame(run)) continue;
    const PackedSurfaces surfaces = packed(read_fragment_surfaces(run.frame));
    html +=
        fmt::format("<script type=\"text/plain\" id=\"frame-{}\">{}</script>\n", frames.size(), base64(surfaces.bytes));
    frames.push_back({{"name", run.name},
                      {"caption", run.caption},
                      {"wall", run.has_wall},
                      {"origin", surfaces.origin},
                      {"step", surfaces.step},
                      {"fragments", surfaces.num_fragments},
                      {"points", surfaces.num_points},
                      {"triangles", surfaces.num_triangles}});
  }
  return fmt::format("<script type=\"application/json\" id=\"frames\">{}</script>\n", text_of(frames)) + html;
}

}  // namespace knap
