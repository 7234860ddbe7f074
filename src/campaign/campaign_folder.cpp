#include "campaign/campaign_folder.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "config/load_config.hpp"
#include "core/errors.hpp"
#include "io/csv_line.hpp"
#include "io/file_output.hpp"

namespace knap {
namespace {

namespace fs = std::filesystem;

// A network file system is made to look at the server again by opening the folder, not by asking for a file in it.
void look_again(const fs::path& path) {
  std::error_code ignored;
  const fs::directory_iterator opened(path, ignored);
}

// Empty if there is none.
nlohmann::json report_in(const fs::path& run) {
  std::ifstream file(run / "report.json");
  const auto json = nlohmann::json::parse(file, nullptr, false);
  return json.is_object() ? json : nlohmann::json::object();
}

}  // namespace

std::string_view name(RunState state) {
  switch (state) {
    case RunState::Waiting:
      return "waiting";
    case RunState::Running:
      return "running";
    case RunState::Done:
      return "done";
    case RunState::Failed:
      break;
  }
  return "failed";
}

RunStatus status_of(const CampaignFolder& folder, const CampaignConfig& campaign, const CampaignRun& run) {
  RunStatus status;
  if (fs::exists(folder.failure(run)))
    return {.state = RunState::Failed, .reason = std::string(trimmed(read_text(folder.failure(run))))};
  look_again(folder.runs());
  look_again(folder.run(run));
  const fs::path effective = folder.run(run) / "effective.toml";
  if (!fs::exists(effective)) return status;
  if (read_text(effective) != effective_toml(load_config(campaign.base, settings_of(campaign, run))))
    throw InputError(fmt::format(
        "{}: was run with another case: the campaign or its base has changed since; give another folder with --out",
        folder.run(run).string()));
  if (report_in(folder.run(run)).value("status", "") == "finished") status.state = RunState::Done;
  for (const char* checkpoint : {"checkpoint.h5", "impact_1/checkpoint.h5"})  // the latter of repeated impacts
    status.can_resume = status.can_resume || fs::exists(folder.run(run) / checkpoint);
  return status;
}

RunCost cost_of(const CampaignFolder& folder, const CampaignRun& run) {
  const auto performance = report_in(folder.run(run)).value("performance", nlohmann::json::object());
  RunCost cost{.core_seconds = performance.value("wall_s", 0.0) * performance.value("threads", 1.0)};
  for (const auto& entry : fs::recursive_directory_iterator(folder.run(run)))
    if (entry.is_regular_file()) cost.bytes += static_cast<double>(entry.file_size());
  return cost;
}

void record_failure(const CampaignFolder& folder, const CampaignRun& run, const std::string& reason) {
  fs::create_directories(folder.failure(run).parent_path());
  write_text_atomically(folder.failure(run), reason + "\n");
}

void forget_failure(const CampaignFolder& folder, const CampaignRun& run) { fs::remove(folder.failure(run)); }

std::string reason_of(const CampaignFolder& folder, const CampaignRun& run, const JobEnd& end) {
  std::string reason;
  std::ifstream log(folder.log(run));
  for (std::string line; std::getline(log, line);)
    if (line.starts_with("error: ")) reason = line.substr(7);
  if (!reason.empty()) return reason;
  const bool is_signal = end.exit_code > 128 && end.exit_code != static_cast<int>(ExitCode::Interrupted);
  reason = end.is_lost ? "lost"
           : is_signal ? fmt::format("ended by signal {}", end.exit_code - 128)
                       : fmt::format("ended with code {}", end.exit_code);
  return end.reason.empty() ? reason : fmt::format("{} ({})", reason, end.reason);
}

std::string disk_failure(const CampaignFolder& folder, const std::string& reason) {
  const auto tells_so = [](const std::string& text) {
    return text.find(std::strerror(ENOSPC)) != std::string::npos ||
           text.find(std::strerror(EDQUOT)) != std::string::npos;
  };
  if (tells_so(reason)) return reason;
  const fs::path probe = folder.path / "room";  // what a run could not write may have been its own log
  try {
    write_text_atomically(probe, std::string(65536, '.'));
  } catch (const RuntimeFailure& failure) {
    return tells_so(failure.what()) ? failure.what() : "";
  }
  fs::remove(probe);
  return "";
}

}  // namespace knap
