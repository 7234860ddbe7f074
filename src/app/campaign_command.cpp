#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <set>
#include <thread>

#include "app/campaign_costs.hpp"
#include "app/commands.hpp"
#include "app/interrupt.hpp"
#include "app/terminal.hpp"
#include "campaign/run_campaign.hpp"
#include "campaign/slurm_engine.hpp"
#include "io/csv_line.hpp"

namespace knap {
namespace {

namespace fs = std::filesystem;

std::string campaign_name(const fs::path& file) {
  const std::string stem = file.stem().string();  // NAME.campaign of NAME.campaign.toml
  return stem.ends_with(".campaign") ? stem.substr(0, stem.size() - 9) : stem;
}

CampaignFolder folder_of(const CampaignArguments& arguments) {
  return {arguments.out.empty() ? fs::path("out") / campaign_name(arguments.campaign_file) : arguments.out};
}

int num_jobs(const CampaignArguments& arguments) {
  return arguments.jobs > 0 ? arguments.jobs : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

// One thread a run unless the campaign says otherwise: runs side by side use all cores.
CampaignConfig load(const CampaignArguments& arguments) {
  if (arguments.campaign_file.empty())
    throw InputError("campaign: give a campaign file, such as cases/smoke.campaign.toml");
  CampaignConfig campaign = load_campaign(arguments.campaign_file);
  campaign.settings.insert(campaign.settings.begin(), Setting("run.threads=1"));
  return campaign;
}

std::string duration(double seconds) {
  if (seconds < 99.5) return fmt::format("{:.0f} s", seconds);
  if (seconds < 5970.0) return fmt::format("{:.0f} min", seconds / 60.0);
  return fmt::format("{:.1f} h", seconds / 3600.0);
}

void show(const CampaignProgress& now, bool is_live) {
  std::string line = fmt::format("{} of {} done, {} running, {} failed, {} waiting", now.done, now.total(), now.running,
                                 now.failed, now.waiting);
  if (now.seconds_left > 0.0 && now.running > 0) line += fmt::format(", about {} left", duration(now.seconds_left));
  if (!now.remark.empty()) line += fmt::format(" ({})", now.remark);
  if (is_live)
    fmt::print("\r\x1b[K{}", line);
  else
    fmt::print("{}\n", line);
  std::fflush(stdout);
}

// On a terminal always; in a file only when something has changed.
std::function<void(const CampaignProgress&)> live_table() {
  const bool is_live = is_terminal(STDOUT_FILENO);
  return [is_live, last = std::size_t{0}, remark = std::string(), first = true](const CampaignProgress& now) mutable {
    if (!is_live && !first && now.done + now.failed == last && now.remark == remark) return;
    last = now.done + now.failed, remark = now.remark, first = false;
    show(now, is_live);
  };
}

// By what the runs done have cost; every run alike, since a larger campaign has the same axes with more values.
void tell_scale(const CampaignConfig& campaign, const CampaignFolder& folder) {
  constexpr double large = 10000.0;
  RunCost sum;
  double done = 0.0;
  for (const CampaignRun& run : campaign_runs(campaign)) {
    if (status_of(folder, campaign, run).state != RunState::Done) continue;
    const RunCost cost = cost_of(folder, run);
    sum.core_seconds += cost.core_seconds, sum.bytes += cost.bytes, ++done;
  }
  if (done == 0.0)
    throw InputError(fmt::format("{}: no run is done yet: --scale tells by measured times", folder.path.string()));
  fmt::print("10,000 such runs: {:.3g} core hours, {:.3g} GB, by {} done: {:.3g} s and {:.3g} MB each\n",
             large / 3600.0 * sum.core_seconds / done, 1e-9 * large * sum.bytes / done, done, sum.core_seconds / done,
             1e-6 * sum.bytes / done);
}

void tell_failures(const CampaignConfig& campaign, const CampaignFolder& folder) {
  for (const CampaignRun& run : campaign_runs(campaign))
    if (const RunStatus status = status_of(folder, campaign, run); status.state == RunState::Failed)
      fmt::print(stderr, "error: {}: {}\n", run.name, status.reason);
}

// Runs of values that the campaign has no more lie in its folder and count for nothing.
void tell_orphans(const CampaignFolder& folder, const std::vector<CampaignRun>& runs) {
  if (!fs::exists(folder.runs())) return;
  std::set<std::string> names, orphans;
  for (const CampaignRun& run : runs) names.insert(run.name);
  for (const auto& entry : fs::directory_iterator(folder.runs()))
    if (entry.is_directory() && !names.contains(entry.path().filename().string()))
      orphans.insert(entry.path().filename().string());
  if (orphans.empty()) return;
  fmt::print("{} lie in {} that the campaign has no more, such as {}; they are left out of results.csv\n",
             orphans.size() == 1 ? "results of a run" : fmt::format("results of {} runs", orphans.size()),
             folder.runs().string(), *orphans.begin());
}

// The most that any run wants; none where one wants all there are.
int cpus_of_runs(const std::vector<ExpectedCost>& costs) {
  int cpus = 1;
  for (const ExpectedCost& cost : costs) {
    if (cost.threads == 0) return 0;
    cpus = std::max(cpus, cost.threads);
  }
  return cpus;
}

std::unique_ptr<Engine> engine_of(const CampaignArguments& arguments, const CampaignFolder& folder,
                                  const std::vector<ExpectedCost>& costs) {
  if (arguments.uses_slurm) {
    if (arguments.slurm_options.find('\n') != std::string::npos) throw InputError("--slurm-options: must be one line");
    return make_slurm_engine({folder.path, arguments.jobs, cpus_of_runs(costs), arguments.slurm_options});
  }
  if (!arguments.slurm_options.empty()) throw InputError("--slurm-options: needs --engine slurm");
  if (const std::string jobs = open_slurm_jobs(folder.path); !jobs.empty())
    throw InputError(
        fmt::format("{}: jobs of this campaign may still run under Slurm ({}): go on with --engine slurm, or, if they "
                    "are gone for certain, remove the folder {}",
                    folder.path.string(), jobs, slurm_folder(folder.path).string()));
  return make_local_engine(num_jobs(arguments));
}

// The runs are done whatever becomes of their analysis, which is made again the next time.
bool analyses(const fs::path& folder) {
  try {
    return analyse_command({.folders = {folder}}) == ExitCode::Ok;
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: the runs are done, but not analysed: {}\n", error.what());
    return false;
  }
}

}  // namespace

ExitCode campaign_plan_command(const CampaignArguments& arguments) {
  const CampaignConfig campaign = load(arguments);
  const CampaignFolder folder = folder_of(arguments);
  const std::vector<CampaignRun> runs = campaign_runs(campaign);
  const std::vector<ExpectedCost> costs = checked_costs(campaign, runs);
  double seconds = 0.0, most = 0.0;
  std::size_t done = 0, width = 3;
  for (const CampaignRun& run : runs) width = std::max(width, run.name.size());
  fmt::print("{:<{}} {:>8} {:>8} {:>9} {}\n", "run", width, "tets", "time", "memory", "state");
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const RunStatus status = status_of(folder, campaign, runs[i]);
    fmt::print("{:<{}} {:>8} {:>8} {:>6.0f} MB {}\n", runs[i].name, width, costs[i].tets, duration(costs[i].seconds),
               1e-6 * costs[i].bytes, name(status.state));
    if (status.state == RunState::Done)
      ++done;
    else
      seconds += costs[i].seconds;
    most = std::max(most, costs[i].bytes);
  }
  const int jobs = num_jobs(arguments);
  fmt::print("\n{} runs, {} done; about {} of one core for the others, {} with {} at a time; memory up to {:.2g} GB\n",
             runs.size(), done, duration(seconds), duration(seconds / jobs), jobs, 1e-9 * most * jobs);
  tell_orphans(folder, runs);
  if (arguments.scales) tell_scale(campaign, folder);
  std::fflush(stdout);
  return ExitCode::Ok;
}

ExitCode campaign_command(const CampaignArguments& arguments) {
  const CampaignConfig campaign = load(arguments);
  const CampaignFolder folder = folder_of(arguments);
  const std::vector<CampaignRun> runs = campaign_runs(campaign);
  const std::vector<ExpectedCost> costs = checked_costs(campaign, runs);
  catch_interrupts();
  const auto engine = engine_of(arguments, folder, costs);
  CampaignOptions options{folder, read_text(arguments.campaign_file), fs::read_symlink("/proc/self/exe"),
                          arguments.retries_failed};
  for (const ExpectedCost& cost : costs) options.efforts.push_back(cost.seconds);
  const CampaignProgress end = run_campaign(campaign, options, *engine, live_table(), interrupt_requested());
  if (is_terminal(STDOUT_FILENO)) fmt::print("\n");
  tell_failures(campaign, folder);
  if (end.waiting > 0) {
    fmt::print(stderr, "interrupted; the same command goes on with it\n");
    return ExitCode::Interrupted;
  }
  fmt::print("{} runs done ({} of them before), {} failed; results in {}\n", end.done, end.done_before, end.failed,
             folder.results().string());
  if (end.failed > 0)
    fmt::print("what failed is tried again with --retry; its output is in {}/logs\n", folder.path.string());
  tell_orphans(folder, runs);
  std::fflush(stdout);
  const bool has_new_runs = end.done > end.done_before || !fs::exists(folder.path / "report.html");
  const bool is_analysed = end.done == 0 || !has_new_runs || analyses(folder.path);
  return end.failed > 0 || !is_analysed ? ExitCode::Failure : ExitCode::Ok;
}

}  // namespace knap
