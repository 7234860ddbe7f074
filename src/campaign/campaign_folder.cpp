#include "campaign/campaign_folder.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "config/load_config.hpp"
#include "core/errors.hpp"
#include "io/csv_line.hpp"
#include "io/file_output.hpp"

namespace knap {
namespace {

namespace fs = std::filesystem;

bool is_finished(const fs::path& report) {
  std::ifstream file(report);
  const auto json = nlohmann::json::parse(file, nullptr, false);
  return !json.is_discarded() && json.value("status", "") == "finished";
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
  if (is_finished(folder.run(run) / "report.json")) status.state = RunState::Done;
  status.can_resume = fs::exists(folder.run(run) / "checkpoint.h5");
  return status;
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
