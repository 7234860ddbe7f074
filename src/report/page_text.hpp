#pragma once
#include <map>
#include <string>
#include <string_view>

namespace knap {

/// JSON as the content of a <script>: nothing in it can end the element.
std::string script_safe(std::string json);
/// RFC 4648, padded.
std::string base64(std::string_view bytes);
/// `bytes` as the source of an <img>.
std::string data_url(std::string_view type, std::string_view bytes);
/// The template with each {{name}} replaced by values[name]; what is put in is not looked at again. Throws
/// std::out_of_range for a name without value.
std::string expanded(std::string_view page, const std::map<std::string, std::string_view>& values);

}  // namespace knap
