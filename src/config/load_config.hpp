#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "config/case_document.hpp"
#include "config/run_config.hpp"

namespace knap {

/// Reads a case file, lets what is set beside it win over it, checks everything and fills in all defaults. Throws
/// InputError with one line for each mistake found, as "case.toml:12:9: impact.speed = ...".
RunConfig load_config(const std::filesystem::path& case_file, std::span<const Setting> settings);
/// With what --set gives: `section.key=value`.
RunConfig load_config(const std::filesystem::path& case_file, std::span<const std::string> overrides = {});

/// The same from the text of a case; `case_file` is named in messages and its folder is where relative paths start.
RunConfig config_from_text(std::string_view text, const std::filesystem::path& case_file,
                           std::span<const std::string> overrides = {});

/// The configuration as a case file with every key written out; loading it gives the identical RunConfig.
std::string effective_toml(const RunConfig& config);

}  // namespace knap
