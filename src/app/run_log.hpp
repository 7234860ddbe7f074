#pragma once
#include <spdlog/spdlog.h>

#include <filesystem>
#include <functional>
#include <sstream>
#include <string>

namespace knap {

/// What a run says while it goes: to the terminal (only warnings and errors when quiet) and to its log file.
class RunLog {
 public:
  explicit RunLog(bool quiet);
  RunLog(const RunLog&) = delete;
  RunLog& operator=(const RunLog&) = delete;

  /// Appends to this file what has been said so far, and then all that is said.
  void start_file(const std::filesystem::path& file);

  void info(const std::string& text);
  void warn(const std::string& text);
  void error(const std::string& text);
  /// To the file alone.
  void note(const std::string& text);
  /// Called before anything is printed: makes room where a progress line stands.
  void before_printing(std::function<void()> action) { before_printing_ = std::move(action); }

 private:
  void print(spdlog::level::level_enum level, const std::string& text);

  std::ostringstream before_file_;  ///< what the file will start with
  spdlog::logger file_;
  spdlog::logger terminal_;
  std::function<void()> before_printing_;
};

}  // namespace knap
