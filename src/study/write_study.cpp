#include "study/write_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/errors.hpp"
#include "io/file_output.hpp"
#include "study/breakage_findings.hpp"
#include "study/chipping_findings.hpp"
#include "study/energy_findings.hpp"
#include "study/findings.hpp"
#include "study/size_findings.hpp"
#include "study/summary_table.hpp"
#include "study/velocity_findings.hpp"

namespace knap {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr auto analysis_file = "analysis.json";

// The last frame of a run; empty if it wrote none.
fs::path last_frame(const fs::path& run) {
  fs::path last;
  if (!fs::is_directory(run / "frames")) return last;
  for (const auto& entry : fs::directory_iterator(run / "frames"))
    if (entry.path().extension() == ".vtu" && (last.empty() || last < entry.path())) last = entry.path();
  return last;
}

// Of each class the runs in the middle and at the ends of its range of lost mass, of those that can be shown.
std::vector<PageRun> chosen_runs(const Study& study) {
  std::map<std::string, std::vector<const StudyRun*>> by_class;
  for (const StudyRun& run : study.runs)
    if (fs::exists(run.folder / "picture.png") || !last_frame(run.folder).empty())
      by_class[run.breakage_class].push_back(&run);
  std::vector<PageRun> chosen;
  for (const char* name : {"fragmented", "split", "chipped", "intact"}) {
    auto& runs = by_class[name];
    std::stable_sort(runs.begin(), runs.end(),
                     [](const StudyRun* a, const StudyRun* b) { return a->chipping_ratio() > b->chipping_ratio(); });
    std::vector<const StudyRun*> picked;
    const std::size_t most = name == std::string("intact") ? 1 : 3;
    for (std::size_t k = 0; k < std::min(most, runs.size()); ++k)
      picked.push_back(runs[most < 2 ? 0
                                     : k * (runs.size() - 1) /
                                           (std::min(most, runs.size()) > 1 ? std::min(most, runs.size()) - 1 : 1)]);
    for (const StudyRun* run : picked)
      chosen.push_back(
          {.name = run->name,
           .caption = (run->has_wall ? fmt::format("{:g} m/s, {:.3g}°: ", run->speed, run->angle / degree) : "") +
                      fmt::format("{}, {:.3g} % lost", run->breakage_class, 100.0 * run->chipping_ratio()),
           .picture = run->folder / "picture.png",
           .frame = last_frame(run->folder),
           .has_wall = run->has_wall});
  }
  return chosen;
}

std::string counts(const Study& study) {
  std::string text =
      fmt::format("{} runs done, {} failed, {} not done", study.runs.size(), study.failed, study.waiting);
  if (!study.unreadable.empty()) text += fmt::format(", {} left out: cannot be read", study.unreadable.size());
  return text;
}

// An analysis is known by its analysis.json, which is written first and last: nothing else is replaced.
void check_place(const fs::path& out, const fs::path& page) {
  if (fs::exists(out / analysis_file)) return;
  const bool holds_other = fs::exists(out) && !fs::is_empty(out);
  if (holds_other || fs::exists(page))
    throw InputError(fmt::format("{}: is there already, and {} holds no analysis; give another folder with --out",
                                 (holds_other ? out : page).string(), out.string()));
}

// What an earlier analysis has left and this one may not write.
void remove_earlier(const fs::path& out, const fs::path& page) {
  fs::remove(page);
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(out)) {
    const fs::path ending = entry.path().extension();
    const bool is_ours = ending == ".png" || ending == ".svg" || ending == ".csv" || ending == ".json";
    if (is_ours && entry.path().filename() != analysis_file) files.push_back(entry.path());
  }
  for (const fs::path& file : files) fs::remove(file);
}

}  // namespace

StudyOutcome write_study(std::span<const fs::path> folders, const fs::path& out, const fs::path& page,
                         const StudyOptions& options) {
  const auto tell = [&](const std::string& what) {
    if (options.tell) options.tell(what);
  };
  tell("reading the runs");
  const Study study = read_study(folders, options.sieve);
  check_place(out, page);
  fs::create_directories(out);
  write_text_atomically(out / analysis_file, Json{{"title", options.title}, {"status", "unfinished"}}.dump(2) + "\n");
  remove_earlier(out, page);
  Findings findings{.folder = out};
  findings.json = {
      {"title", options.title},
      {"runs", {{"done", study.runs.size()}, {"failed", study.failed}, {"not_done", study.waiting}}},
      {"sieve_m", options.sieve > 0.0 ? Json(options.sieve) : Json("the diameter over 2^(1/4)")},
      {"units", "SI; angles in degrees from the plane of the wall where a name says deg; intervals are 95 %"}};
  constexpr std::size_t most_drawn = 20;
  if (const std::size_t series = series_of(study).size(); series > most_drawn) {
    findings.has_plots = false;
    findings.verdicts.push_back(fmt::format("{} series are too many to draw: numbers only.", series));
  }
  tell("the summary");
  add_summary(findings, study);
  tell("breakage over speed and angle, the equivalent velocity");
  add_velocity_findings(findings, study, options.normal_speeds, options.collapse_samples);
  tell("the chipping law");
  add_chipping_findings(findings, study);
  tell("size distributions");
  add_size_findings(findings, study);
  tell("breakage functions");
  add_breakage_findings(findings, study, options.broken);
  tell("energies");
  add_energy_findings(findings, study);
  findings.json["verdicts"] = findings.verdicts;
  write_text_atomically(out / analysis_file, findings.json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  tell("report.html");
  write_campaign_page(page, {.title = options.title,
                             .subtitle = counts(study),
                             .verdicts = findings.verdicts,
                             .sections = findings.sections,
                             .runs_table = {.columns = study.table.columns, .rows = study.table.rows},
                             .runs = chosen_runs(study)});
  return {study.runs.size(), study.failed, study.waiting, study.unreadable, findings.verdicts};
}

}  // namespace knap
