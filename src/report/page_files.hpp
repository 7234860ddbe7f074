#pragma once
#include <string_view>

/// The files of report/page/ and three.js as they were when the program was built.
namespace knap::page_files {

extern const std::string_view page_html, page_css, fragments_js, viewer_js, runs_table_js, page_js;
extern const std::string_view three_min_js, three_licence_txt;

}  // namespace knap::page_files
