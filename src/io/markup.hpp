#pragma once
#include <string>
#include <string_view>

namespace knap {

/// The text as content or quoted attribute of XML and HTML.
std::string markup_escaped(std::string_view text);

}  // namespace knap
