#pragma once
#include <filesystem>

#include "io/vtk_writer.hpp"
#include "report/campaign_page.hpp"

namespace knap {

/// A ball on the wall z = 0 of cubes of six tets, `n` along a diameter, cut into `num_large` sectors of descending
/// size and grains of one cube where it touched the wall; the pieces slightly apart.
VtkGrid broken_ball_frame(Index n, Index num_large);

/// A campaign of 40 runs, two of which can be turned in 3-D; its figures, pictures and frames are written into
/// `folder`. Names and texts have all that HTML and scripts must not trip over.
CampaignPage sample_campaign(const std::filesystem::path& folder);

}  // namespace knap
