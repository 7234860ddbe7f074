#include "core/log.hpp"

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>

namespace knap {
namespace {

spdlog::logger log_to(spdlog::sink_ptr sink, const char* pattern) {
  sink->set_pattern(pattern);
  spdlog::logger log("knap", std::move(sink));
  log.flush_on(spdlog::level::info);
  return log;
}

constexpr const char* line_pattern = "%Y-%m-%d %H:%M:%S %l: %v";

}  // namespace

spdlog::logger terminal_log(bool quiet) {
  spdlog::logger log = log_to(std::make_shared<spdlog::sinks::stderr_color_sink_st>(), "%^%v%$");
  log.set_level(quiet ? spdlog::level::warn : spdlog::level::info);
  return log;
}

spdlog::logger file_log(const std::filesystem::path& file) {
  return log_to(std::make_shared<spdlog::sinks::basic_file_sink_st>(file.string(), false), line_pattern);
}

spdlog::logger stream_log(std::ostream& stream) {
  return log_to(std::make_shared<spdlog::sinks::ostream_sink_st>(stream), line_pattern);
}

}  // namespace knap
