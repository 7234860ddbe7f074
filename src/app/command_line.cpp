#include "app/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <new>

#include "app/commands.hpp"
#include "version.hpp"

namespace knap {
namespace {

int code(ExitCode exit_code) { return static_cast<int>(exit_code); }

// A message of several lines keeps its mark on every one. Where it cannot be written there is nobody left to tell.
int fail(const std::string& message, ExitCode exit_code) {
  std::size_t begin = 0;
  while (begin <= message.size()) {
    const std::size_t end = std::min(message.find('\n', begin), message.size());
    std::fputs(fmt::format("error: {}\n", message.substr(begin, end - begin)).c_str(), stderr);
    begin = end + 1;
  }
  return code(exit_code);
}

void add_case(CLI::App* command, std::filesystem::path& case_file, std::vector<std::string>& overrides) {
  command->add_option("CASE", case_file, "Case file (TOML)")->required();
  command->add_option("--set", overrides, "Replace a value of the case: section.key=value; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

CLI::App* add_run(CLI::App& app, RunArguments& run) {
  CLI::App* command = app.add_subcommand("run", "Break a particle: mesh, simulate, write fragments, energy, pictures");
  add_case(command, run.case_file, run.overrides);
  command->add_option("--out", run.out, "Folder of the results; default: out/<name of the case>")->type_name("DIR");
  command->add_option("--threads", run.threads, "Number of threads; results do not depend on it")
      ->type_name("N")
      ->check(CLI::Range(0, 1024));
  auto* resume = command->add_flag("--resume", run.resume, "Continue an interrupted run from its checkpoint");
  command->add_flag("--overwrite", run.overwrite, "Replace the results of an earlier run")->excludes(resume);
  command->add_flag("--quiet", run.quiet, "Print nothing but warnings and errors");
  return command;
}

CLI::App* add_modes(CLI::App& app, ModesArguments& modes) {
  CLI::App* command = app.add_subcommand("modes", "Find the free vibrations of the particle of a case");
  add_case(command, modes.case_file, modes.overrides);
  command->add_option("--count", modes.count, "How many, without the rigid motions")->check(CLI::Range(1, 10000));
  command->add_option("--out", modes.out, "Folder of the results; default: out/<name of the case>_modes")
      ->type_name("DIR");
  return command;
}

CLI::App* add_strength(CLI::App& app, StrengthArguments& strength) {
  CLI::App* command = app.add_subcommand("strength", "Press a particle for many seeds: Weibull statistics of strength");
  add_case(command, strength.case_file, strength.overrides);
  command->add_option("--seeds", strength.seeds, "Number of runs, with run.seed = 1, 2, ...")
      ->type_name("N")
      ->check(CLI::Range(2, 9999));
  command->add_option("--out", strength.out, "Folder of the results; default: out/<name of the case>_strength")
      ->type_name("DIR");
  command->add_option("--threads", strength.threads, "Number of threads; results do not depend on it")
      ->type_name("N")
      ->check(CLI::Range(0, 1024));
  return command;
}

/// `knap campaign FILE` and `knap campaign plan FILE`.
struct CampaignApps {
  CLI::App* run;
  CLI::App* plan;
};

CampaignApps add_campaign(CLI::App& app, CampaignArguments& campaign) {
  CLI::App* command =
      app.add_subcommand("campaign", "Run many cases: speeds, angles, seeds, any keys; or go on with them");
  CLI::App* plan = command->add_subcommand("plan", "Show the runs of a campaign, their expected time and memory");
  for (CLI::App* one : {command, plan}) {
    one->add_option("FILE", campaign.campaign_file, "Campaign file (TOML)")->required(one == plan);
    one->add_option("--out", campaign.out, "Folder of the results; default: out/<name of the campaign>")
        ->type_name("DIR");
    one->add_option("--jobs", campaign.jobs, "Runs at a time; default: one a core, under Slurm as many as it runs")
        ->type_name("N")
        ->check(CLI::Range(1, 1024));
  }
  plan->add_flag("--scale", campaign.scales, "Tell by the runs done what 10,000 such runs cost in core hours and disk");
  command->add_flag("--retry", campaign.retries_failed, "Try again what has failed");
  command
      ->add_option_function<std::string>(
          "--engine", [&campaign](const std::string& engine) { campaign.uses_slurm = engine == "slurm"; },
          "Where the runs run: on this machine, or in array jobs of Slurm; default: local")
      ->type_name("ENGINE")
      ->check(CLI::IsMember({"local", "slurm"}));
  command
      ->add_option("--slurm-options", campaign.slurm_options,
                   "Options of sbatch: \"--partition=long --time=2:00:00 --mem=2G\"")
      ->type_name("TEXT");
  return {command, plan};
}

CLI::App* add_analyse(CLI::App& app, AnalyseArguments& analyse) {
  CLI::App* command =
      app.add_subcommand("analyse", "Analyse the runs of campaigns: breakage curves, laws, plots, report.html");
  command->add_option("FOLDER", analyse.folders, "Folders of campaigns; several are taken together")->required();
  command->add_option("--out", analyse.out, "Folder of report.html and analysis/; default: the first FOLDER")
      ->type_name("DIR");
  command->add_option("--sieve", analyse.sieve, "Sieve of the breakage ratio; default: the diameter over 2^(1/4)")
      ->type_name("LENGTH");
  command->add_option("--broken", analyse.broken, "Mass loss from which a particle is broken")
      ->check(CLI::Range(1e-6, 1.0))
      ->capture_default_str();
  command
      ->add_option("--normal-speeds", analyse.normal_speeds,
                   "Speeds towards the wall at which the tangential effect is told; default: \"8 m/s,14 m/s\"")
      ->type_name("V,...")
      ->delimiter(',');
  command->alias("analyze");
  return command;
}

// CLI11 only says that a command is required.
void check_command_name(const CLI::App& app, const std::string& word) {
  if (word.empty() || word.front() == '-') return;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->check_name(word)) return;
    names.push_back(command->get_name());
  }
  const std::string nearest = nearest_name(word, names);
  throw InputError(fmt::format("knap has no command \"{}\"{}; knap --help lists them", word,
                               nearest.empty() ? "" : fmt::format(" (did you mean \"{}\"?)", nearest)));
}

int run_parsed(int argc, char** argv) {
  CLI::App app{"Knap breaks a granule: fracture of a single particle on impact", "knap"};
  app.set_version_flag("--version", std::string("knap ") + version);
  app.require_subcommand(1);
  RunArguments run;
  StrengthArguments strength;
  CheckArguments check;
  MeshArguments mesh;
  ModesArguments modes;
  CampaignArguments campaign;
  AnalyseArguments analyse;
  bool markdown = false;
  const CLI::App* run_app = add_run(app, run);
  const CLI::App* strength_app = add_strength(app, strength);
  CLI::App* check_app = app.add_subcommand("check", "Validate a case and print its sanity card");
  add_case(check_app, check.case_file, check.overrides);
  CLI::App* mesh_app = app.add_subcommand("mesh", "Mesh the particle of a case and report the quality");
  add_case(mesh_app, mesh.case_file, mesh.overrides);
  mesh_app->add_option("--out", mesh.out, "Where to write the mesh (.vtu)")->type_name("FILE")->required();
  const CLI::App* modes_app = add_modes(app, modes);
  const CampaignApps campaign_apps = add_campaign(app, campaign);
  const CLI::App* analyse_app = add_analyse(app, analyse);
  CLI::App* keys_app = app.add_subcommand("keys", "Print every key of a case file");
  keys_app->add_flag("--markdown", markdown, "As a page of documentation");
  if (argc > 1) check_command_name(app, argv[1]);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? code(ExitCode::Ok) : code(ExitCode::BadInput);
  }
  if (*run_app) return code(run_command(run));
  if (*strength_app) return code(strength_command(strength));
  if (*check_app) return code(check_command(check));
  if (*mesh_app) return code(mesh_command(mesh));
  if (*modes_app) return code(modes_command(modes));
  if (*campaign_apps.plan) return code(campaign_plan_command(campaign));
  if (*campaign_apps.run) return code(campaign_command(campaign));
  if (*analyse_app) return code(analyse_command(analyse));
  return code(keys_command(markdown));
}

}  // namespace

int run_command_line(int argc, char** argv) {
  try {
    return run_parsed(argc, argv);
  } catch (const InputError& error) {
    return fail(error.what(), ExitCode::BadInput);
  } catch (const std::bad_alloc&) {
    return fail("not enough memory", ExitCode::Failure);
  } catch (const std::exception& error) {
    return fail(error.what(), ExitCode::Failure);
  }
}

}  // namespace knap
