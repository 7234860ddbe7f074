#pragma once
#include <string>

#include "report/campaign_page.hpp"

namespace knap {

/// The parts of the page that are plain HTML: verdicts, contents, the sections, the pictures of runs.
std::string verdicts_html(const CampaignPage& page);
std::string contents_html(const CampaignPage& page);
/// Throws InputError naming a figure that cannot be read.
std::string sections_html(const CampaignPage& page);
/// Throws InputError naming a picture that cannot be read.
std::string gallery_html(const CampaignPage& page);

bool has_picture(const PageRun& run);
bool has_frame(const PageRun& run);

}  // namespace knap
