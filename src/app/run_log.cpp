#include "app/run_log.hpp"

#include "core/log.hpp"

namespace knap {
namespace {

// make_log puts the terminal first and the file last. Only the file's lines name their level by themselves.
spdlog::logger part(const spdlog::sink_ptr& sink) {
  spdlog::logger logger("knap", sink);
  logger.flush_on(spdlog::level::info);
  return logger;
}

}  // namespace

RunLog::RunLog(const std::filesystem::path& file, bool quiet)
    : file_("none"), terminal_("none"), before_printing_([] {}) {
  const auto log = make_log(file, quiet);
  terminal_ = part(log->sinks().front());
  file_ = part(log->sinks().back());
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
