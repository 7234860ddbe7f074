#include "app/campaign_costs.hpp"

#include <fmt/format.h>

#include <map>
#include <sstream>

#include "app/run_sanity.hpp"
#include "config/load_config.hpp"
#include "core/errors.hpp"

namespace knap {
namespace {

// Time of a run before its first step: the program itself and a small mesh [s].
constexpr double start_seconds = 0.5;
// Memory of a breaking run over its tets (README, Figures), and of the program itself [bytes].
constexpr double memory_of_tet = 1300.0, memory_of_program = 60e6;

ExpectedCost expected_cost(const SanityCard& card, int threads) {
  const double tets = card.input.num_tets;
  return {tets, start_seconds + card.wall_time, memory_of_program + memory_of_tet * tets, threads};
}

// What a run computes, as text: the case without what changes no number of it.
std::string computed_case(RunConfig config) {
  if (config.impact.repeat == 1) config.run.seed = 0;  // its other uses are resolved by now
  config.run.threads = 0;
  config.output = {};
  for (ParticleConfig& particle : config.particles)
    if (particle.fracture.weibull_modulus == 0.0) particle.fracture.weibull_seed = not_given;
  return effective_toml(config);
}

/// What is wrong with the runs of a campaign: each mistake once, with the runs it is in.
class RunProblems {
 public:
  void add(const std::string& message, const std::string& run) {
    std::istringstream lines(message);
    for (std::string line; std::getline(lines, line);) {
      const auto [found, is_new] = runs_of_.try_emplace(line);
      if (is_new) lines_.push_back(line);
      found->second.push_back(run);
    }
  }

  void throw_if_any() const {
    std::vector<std::string> problems;
    for (const std::string& line : lines_) {
      const std::vector<std::string>& runs = runs_of_.at(line);
      const std::string others = runs.size() > 1 ? fmt::format(" and {} more", runs.size() - 1) : "";
      problems.push_back(fmt::format("{} (run {}{})", line, runs.front(), others));
    }
    knap::throw_if_any(problems);
  }

 private:
  std::vector<std::string> lines_{};
  std::map<std::string, std::vector<std::string>> runs_of_{};
};

}  // namespace

std::vector<ExpectedCost> checked_costs(const CampaignConfig& campaign, const std::vector<CampaignRun>& runs) {
  std::vector<ExpectedCost> costs;
  std::map<std::string, std::string> run_of_case;
  RunProblems problems;
  for (const CampaignRun& run : runs) {
    try {
      const RunConfig config = load_config(campaign.base, settings_of(campaign, run));
      const auto [first, is_new] = run_of_case.emplace(computed_case(config), run.name);
      if (!is_new)
        problems.add(fmt::format("the same run as {}: run.seed changes nothing where mesh.seed is given and strengths "
                                 "do not scatter; vary mesh.seed, or leave it out of the case",
                                 first->second),
                     run.name);
      const SanityCard card = expected_card(config);
      if (!config.particles[0].fracture.allow_unresolved)
        for (const std::string& refusal : refusals(card)) problems.add(refusal, run.name);
      costs.push_back(expected_cost(card, config.run.threads));
    } catch (const InputError& error) {
      problems.add(error.what(), run.name);
    }
  }
  problems.throw_if_any();
  return costs;
}

}  // namespace knap
