#include "campaign/campaign_folder.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "config/load_config.hpp"
#include "core/errors.hpp"
#include "io/csv_line.hpp"
#include "io/file_output.hpp"

namespace knap {
namespace {

namespace fs = std::filesystem;

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
  const fs::path effective = folder.run(run) / "effective.toml";
  if (!fs::exists(effective)) return status;
  if (read_text(effective) != effective_toml(load_config(campaign.base, overrides_of(campaign, run))))
    throw InputError(fmt::format(
        "{}: was run with another case: the campaign or its base has changed since; give another folder with --out",
        folder.run(run).string()));
  if (report_in(folder.run(run)).value("status", "") == "finished") status.state = RunState::Done;
  status.can_resume = fs::exists(folder.run(run) / "checkpoint.h5");
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

std::string reason_of(const CampaignFolder& folder, const CampaignRun& run, int exit_code) {
  std::string reason;
  std::ifstream log(folder.log(run));
  for (std::string line; std::getline(log, line);)
    if (line.starts_with("error: ")) reason = line.substr(7);
  if (!reason.empty()) return reason;
  return exit_code > 128 ? fmt::format("ended by signal {}", exit_code - 128)
                         : fmt::format("ended with code {}", exit_code);
}

}  // namespace knap
