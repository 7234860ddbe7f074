#pragma once
#include <map>
#include <sstream>

#include "io/csv_line.hpp"
#include "tests/app/program.hpp"

namespace knap {

/// A test with a small campaign, study.campaign.toml, that is run into the folder c.
class CampaignRuns : public ProgramTest {
 protected:
  CampaignRuns() {
    write("case.toml", breaking_case);
    write("study.campaign.toml", campaign("[\"15 m/s\", \"25 m/s\"]"));
  }
  static std::string campaign(const std::string& speeds, const std::string& more = "") {
    return "[campaign]\nbase = \"case.toml\"\n[set]\n\"output.frames\" = 0\n\"run.end_time\" = \"6 us\"\n" + more +
           "[[axis]]\nkey = \"impact.speed\"\nvalues = " + speeds + "\n[[axis]]\nkey = \"run.seed\"\nvalues = [1, 2]\n";
  }
  Ended run_campaign(std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"campaign", "study.campaign.toml", "--out", "c"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
  /// Another one, of runs seed_1, seed_2, ...
  static std::string seeds(const std::string& list, const std::string& end_time) {
    return "[campaign]\nbase = \"case.toml\"\n[set]\n\"output.frames\" = 0\n\"run.end_time\" = \"" + end_time +
           "\"\n[[axis]]\nkey = \"run.seed\"\nvalues = " + list + "\n";
  }
  /// The process of a run; -1 = there is none.
  pid_t process_of(const std::string& name) const {
    const std::string out = "/runs/" + name + std::string(1, '\0');
    std::error_code gone;
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
      const std::string words = content(entry.path() / "cmdline");
      if (words.starts_with(KNAP_PROGRAM) && words.find(out) != std::string::npos &&
          std::filesystem::equivalent(entry.path() / "cwd", folder, gone))
        return std::stoi(entry.path().filename());
    }
    return -1;
  }
  /// kill -9 of a run as soon as it runs; returns when its process has gone. False if there is none for long.
  bool kill_run(const std::string& name) const {
    pid_t process = -1;
    for (int i = 0; i < 6000 && (process = process_of(name)) < 0; ++i) nap();
    if (process < 0) return false;
    ::kill(process, SIGKILL);
    while (process_of(name) == process) nap();
    return true;
  }
  /// Of the folder c and of a campaign of the same file that nothing happened to.
  void expect_results_of_undisturbed_runs(const std::string& out = "c") const {
    ASSERT_EQ(run({"campaign", "study.campaign.toml", "--out", "undisturbed"}).code, 0);
    const auto rows = results(out), expected = results("undisturbed");
    ASSERT_EQ(rows.size(), expected.size());
    for (const auto& [name, row] : expected) {
      EXPECT_EQ(rows.at(name).at("state"), "done");
      EXPECT_EQ(rows.at(name).at("state_hash"), row.at("state_hash")) << name;
    }
  }
  /// results.csv: run -> column -> cell.
  std::map<std::string, std::map<std::string, std::string>> results(const std::string& out = "c") const {
    std::map<std::string, std::map<std::string, std::string>> rows;
    std::istringstream text(content(folder / out / "results.csv"));
    std::vector<std::string> header;
    for (std::string line; std::getline(text, line);) {
      const std::vector<std::string> cells = csv_cells(line);
      if (header.empty()) {
        header = cells;
        continue;
      }
      EXPECT_EQ(cells.size(), header.size());
      for (std::size_t i = 0; i < cells.size(); ++i) rows[cells[0]][header[i]] = cells[i];
    }
    return rows;
  }

 private:
  static void nap() { std::this_thread::sleep_for(std::chrono::milliseconds(10)); }
};

}  // namespace knap
