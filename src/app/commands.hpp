#pragma once
// The commands of the program. Each throws InputError for what the user got wrong.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/errors.hpp"

namespace knap {

struct RunArguments {
  std::filesystem::path case_file;
  std::vector<std::string> overrides;  ///< section.key=value
  std::filesystem::path out;           ///< "" = out/<case name>
  std::optional<int> threads;
  bool resume = false;
  bool overwrite = false;
  bool quiet = false;
};
/// Breaks a particle: meshes, runs, writes everything into the run's folder.
ExitCode run_command(const RunArguments& arguments);

struct CheckArguments {
  std::filesystem::path case_file;
  std::vector<std::string> overrides;
};
/// Validates a case and prints its sanity card, without a mesh unless the case brings one.
ExitCode check_command(const CheckArguments& arguments);

struct MeshArguments {
  std::filesystem::path case_file;
  std::vector<std::string> overrides;
  std::filesystem::path out;  ///< .vtu
};
/// Writes the mesh of a case and prints its quality.
ExitCode mesh_command(const MeshArguments& arguments);

struct ModesArguments {
  std::filesystem::path case_file;
  std::vector<std::string> overrides;
  int count = 20;
  std::filesystem::path out;  ///< "" = out/<case name>_modes
};
/// Finds the lowest free vibrations of the particle: frequencies to the terminal and modes.csv, shapes to modes.vtu.
ExitCode modes_command(const ModesArguments& arguments);

struct StrengthArguments {
  std::filesystem::path case_file;
  std::vector<std::string> overrides;
  std::filesystem::path out;  ///< "" = out/<case name>_strength
  std::optional<int> threads;
  int seeds = 10;
};
/// Presses a particle of a case once for each of the seeds 1 to n and fits a Weibull distribution to the strengths.
/// What has been run already is not run again.
ExitCode strength_command(const StrengthArguments& arguments);

struct CampaignArguments {
  std::filesystem::path campaign_file;
  std::filesystem::path out;  ///< "" = out/<name of the campaign>
  int jobs = 0;               ///< runs at a time; 0 = one a core, under Slurm as many as it runs
  bool uses_slurm = false;
  std::string slurm_options;  ///< of sbatch
  bool retries_failed = false;
  bool scales = false;  ///< of the plan: tell what 10,000 such runs cost
};
/// Runs all of a campaign that is not done yet, then analyses it. Fails if a run has failed.
ExitCode campaign_command(const CampaignArguments& arguments);
/// Shows the runs of a campaign with their expected time and memory, and runs nothing.
ExitCode campaign_plan_command(const CampaignArguments& arguments);

struct AnalyseArguments {
  std::vector<std::filesystem::path> folders{};  ///< of campaigns
  std::filesystem::path out{};                   ///< "" = the folder of the first one
  std::string sieve{};                           ///< of the breakage ratio, a length; "" = the diameter over 2^(1/4)
  double broken = 0.1;                           ///< mass loss from which a particle is broken
  std::vector<std::string> normal_speeds{};      ///< of the tangential effect; empty = 8 and 14 m/s
};
/// Analyses the runs of campaigns: fits, tables, plots, report.html.
ExitCode analyse_command(const AnalyseArguments& arguments);

/// Prints every key of a case file.
ExitCode keys_command(bool markdown);

}  // namespace knap
