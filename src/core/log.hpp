#pragma once
#include <spdlog/spdlog.h>

#include <filesystem>

namespace knap {

/// Messages go to the terminal (warnings and worse when quiet) and, once open, to the run's log file.
std::shared_ptr<spdlog::logger> make_log(const std::filesystem::path& file, bool quiet);

}  // namespace knap
