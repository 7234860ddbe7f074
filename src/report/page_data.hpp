#pragma once
#include <string>

#include "report/campaign_page.hpp"

namespace knap {

/// What the page's scripts read, as the contents of <script> elements. Throws std::invalid_argument for a row of
/// another length than the columns.
std::string table_json(const PageTable& table);
/// The elements of all runs with a frame: their names and captions, and the surfaces of their fragments. Throws
/// InputError naming a frame that cannot be read.
std::string frames_html(const CampaignPage& page);

}  // namespace knap
