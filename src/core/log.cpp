#include "core/log.hpp"

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>

namespace knap {

std::shared_ptr<spdlog::logger> make_log(const std::filesystem::path& file, bool quiet) {
  auto terminal = std::make_shared<spdlog::sinks::stderr_color_sink_st>();
  terminal->set_pattern("%^%v%$");
  terminal->set_level(quiet ? spdlog::level::warn : spdlog::level::info);
  std::vector<spdlog::sink_ptr> sinks{terminal};
  if (!file.empty()) {
    sinks.push_back(std::make_shared<spdlog::sinks::basic_file_sink_st>(file.string(), false));
    sinks.back()->set_pattern("%Y-%m-%d %H:%M:%S %l: %v");
  }
  auto log = std::make_shared<spdlog::logger>("knap", sinks.begin(), sinks.end());
  log->flush_on(spdlog::level::info);
  return log;
}

}  // namespace knap
