#include "app/run_log.hpp"

#include <fstream>

#include "core/log.hpp"

namespace knap {

RunLog::RunLog(bool quiet) : file_(stream_log(before_file_)), terminal_(terminal_log(quiet)), before_printing_([] {}) {}

void RunLog::start_file(const std::filesystem::path& file) {
  std::ofstream(file, std::ios::app) << before_file_.str();
  file_ = file_log(file);
}

void RunLog::print(spdlog::level::level_enum level, const std::string& text) {
  before_printing_();
  terminal_.log(level, text);
}

void RunLog::info(const std::string& text) {
  note(text);
  print(spdlog::level::info, text);
}

void RunLog::warn(const std::string& text) {
  file_.warn(text);
  print(spdlog::level::warn, "warning: " + text);
}

void RunLog::error(const std::string& text) {
  file_.error(text);
  print(spdlog::level::err, "error: " + text);
}

void RunLog::note(const std::string& text) { file_.info(text); }

}  // namespace knap
