#pragma once
#include <spdlog/spdlog.h>

#include <filesystem>
#include <iosfwd>

namespace knap {

/// Messages to the terminal: all, or only warnings and worse when quiet.
spdlog::logger terminal_log(bool quiet);
/// Lines with time and level to the end of a file, which is made if there is none.
spdlog::logger file_log(const std::filesystem::path& file);
/// The same lines to a stream that lives longer.
spdlog::logger stream_log(std::ostream& stream);

}  // namespace knap
