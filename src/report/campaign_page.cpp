#include "report/campaign_page.hpp"

#include "io/file_output.hpp"
#include "io/markup.hpp"
#include "report/page_data.hpp"
#include "report/page_files.hpp"
#include "report/page_sections.hpp"
#include "report/page_text.hpp"

namespace knap {

void write_campaign_page(const std::filesystem::path& html, const CampaignPage& page) {
  const std::string title = markup_escaped(page.title), subtitle = markup_escaped(page.subtitle);
  const std::string verdicts = verdicts_html(page), contents = contents_html(page), sections = sections_html(page);
  const std::string gallery = gallery_html(page), table = table_json(page.runs_table), frames = frames_html(page);
  write_text_atomically(html, expanded(page_files::page_html, {{"title", title},
                                                               {"subtitle", subtitle},
                                                               {"verdicts", verdicts},
                                                               {"contents", contents},
                                                               {"sections", sections},
                                                               {"gallery", gallery},
                                                               {"table", table},
                                                               {"frames", frames},
                                                               {"css", page_files::page_css},
                                                               {"three_licence", page_files::three_licence_txt},
                                                               {"three", page_files::three_min_js},
                                                               {"fragments", page_files::fragments_js},
                                                               {"viewer", page_files::viewer_js},
                                                               {"runs_table", page_files::runs_table_js},
                                                               {"page", page_files::page_js}}));
}

}  // namespace knap
