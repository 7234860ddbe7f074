#pragma once
#include "study/findings.hpp"

namespace knap {

/// The straight-on speed at which as much is lost as under each angle, over v sin th: what v_eq would have to be,
/// whatever the law of breakage. Nothing where no impact is straight on.
void add_equal_loss(Findings& findings, const Study& study, const Series& series, const std::string& suffix,
                    nlohmann::ordered_json& json);

}  // namespace knap
