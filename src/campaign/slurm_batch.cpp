#include "campaign/slurm_batch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <fstream>
#include <random>

#include "io/csv_line.hpp"
#include "io/file_output.hpp"

namespace knap {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view name_option = "#SBATCH --job-name=";

// Slurm signals every process of a task, the run among them, when it is cancelled or its time is up: the run saves
// itself and ends, and the shell must live to write its exit code. It is the campaign that decides what runs again.
constexpr const char* script = R"(#!/bin/bash
# Runs of a campaign, one for each line of {stem_name}.tasks. Written and submitted by knap campaign.
#SBATCH --ntasks=1
{cpus}{more}{name_option}{job_name}
#SBATCH --array=0-{last}{throttle}
#SBATCH --no-requeue

batch={stem}
line=$(sed -n "$((SLURM_ARRAY_TASK_ID + 1))p" "$batch.tasks") && [[ -n $line ]] || exit 1
cd {folder} || exit 1

run() {{  # RUN LOG COMMAND ...
  trap : TERM
  "${{@:3}}" >"$2" 2>&1
  local code=$? end=$batch/$SLURM_ARRAY_TASK_ID
  echo $code >"$end.part" && mv "$end.part" "$end.end"
  exit $code
}}
eval "run $line"
)";

std::string unique_job_name(const fs::path& stem) {
  std::string name = fmt::format("knap_{}_{}_{:08x}", stem.parent_path().parent_path().filename().string(),
                                 stem.filename().string(), std::random_device{}());
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_' && c != '-' && c != '.') c = '_';
  return name;
}

int number_of(const fs::path& stem) {
  const std::string name = stem.filename().string();
  int number = 0;
  const std::string_view digits = std::string_view(name).substr(std::min(name.size(), name.find('_') + 1));
  std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return number;
}

fs::path new_stem(const fs::path& folder) {
  int last = 0;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".sh") last = std::max(last, number_of(entry.path().stem()));
  return folder / fmt::format("batch_{:04}", last + 1);
}

std::string table_line(const Job& job) {
  std::string line = job.name + " " + shell_word(fs::absolute(job.log).string());
  for (const std::string& word : job.command) line += " " + shell_word(word);
  return line + "\n";
}

std::string script_of(const SlurmBatch& batch, const SlurmOptions& options, std::size_t num_jobs) {
  return fmt::format(
      fmt::runtime(script), fmt::arg("stem_name", batch.stem.filename().string()), fmt::arg("name_option", name_option),
      fmt::arg("job_name", batch.job_name), fmt::arg("last", num_jobs - 1),
      fmt::arg("throttle", options.most_running > 0 ? fmt::format("%{}", options.most_running) : ""),
      fmt::arg("cpus", options.cpus > 0 ? fmt::format("#SBATCH --cpus-per-task={}\n", options.cpus) : ""),
      fmt::arg("more", options.more.empty() ? "" : fmt::format("#SBATCH {}\n", options.more)),
      fmt::arg("stem", shell_word(batch.stem.string())), fmt::arg("folder", shell_word(fs::current_path().string())));
}

SlurmBatch read_batch(const fs::path& stem) {
  SlurmBatch batch{.stem = stem, .job_name = ""};
  std::ifstream shell(batch.file(".sh")), job(batch.file(".job")), table(batch.file(".tasks"));
  for (std::string line; std::getline(shell, line);)
    if (line.starts_with(name_option)) batch.job_name = line.substr(name_option.size());
  std::getline(job, batch.job_id);
  int index = 0;
  for (std::string line; std::getline(table, line);) batch.tasks[index++].name = line.substr(0, line.find(' '));
  return batch;
}

}  // namespace

fs::path slurm_folder(const fs::path& campaign_folder) { return campaign_folder / "slurm"; }

std::string shell_word(const std::string& text) {
  constexpr std::string_view plain = "_-+=./:,@%";
  const auto is_plain = [plain](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || plain.find(c) != plain.npos;
  };
  if (!text.empty() && std::all_of(text.begin(), text.end(), is_plain)) return text;
  std::string word = "$'";  // one line, whatever it holds
  for (const char c : text) {
    if (c == '\\' || c == '\'') word += '\\';
    if (c == '\n')
      word += "\\n";
    else
      word += c;
  }
  return word + "'";
}

SlurmBatch write_batch(const SlurmOptions& options, const std::vector<Job>& jobs) {
  const fs::path folder = fs::absolute(slurm_folder(options.folder));
  fs::create_directories(folder);
  SlurmBatch batch{.stem = new_stem(folder), .job_name = ""};
  batch.job_name = unique_job_name(batch.stem);
  std::string table;
  for (const Job& job : jobs) {
    fs::remove(job.log);  // of an earlier try
    batch.tasks[static_cast<int>(batch.tasks.size())] = {.name = job.name, .run = job.run};
    table += table_line(job);
  }
  write_text_atomically(batch.file(".tasks"), table);
  write_text_atomically(batch.file(".sh"), script_of(batch, options, jobs.size()));
  fs::create_directory(batch.stem);
  return batch;
}

void record_job(SlurmBatch& batch, const std::string& job_id) {
  batch.job_id = job_id;
  write_text_atomically(batch.file(".job"), job_id + "\n");
}

std::vector<SlurmBatch> open_batches(const fs::path& campaign_folder) {
  std::vector<SlurmBatch> batches;
  const fs::path folder = fs::absolute(slurm_folder(campaign_folder));
  if (!fs::is_directory(folder)) return batches;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_directory() && fs::exists(entry.path().string() + ".sh")) batches.push_back(read_batch(entry.path()));
  std::sort(batches.begin(), batches.end(),
            [](const SlurmBatch& a, const SlurmBatch& b) { return number_of(a.stem) < number_of(b.stem); });
  return batches;
}

// By listing the folder: to open it makes a network file system look at the server, to open a file that was not there
// before may not.
int read_exit_codes(SlurmBatch& batch) {
  int num_new = 0;
  for (const auto& entry : fs::directory_iterator(batch.stem)) {
    if (entry.path().extension() != ".end") continue;
    const std::string name = entry.path().stem().string();
    int index = -1;
    std::from_chars(name.data(), name.data() + name.size(), index);
    const auto task = batch.tasks.find(index);
    if (task == batch.tasks.end() || task->second.exit_code) continue;
    int code = 0;
    if (!(std::ifstream(entry.path()) >> code)) continue;
    task->second.exit_code = code;
    ++num_new;
  }
  return num_new;
}

void forget_end(const SlurmBatch& batch, int index) { fs::remove(batch.stem / fmt::format("{}.end", index)); }

std::string output_option(const SlurmBatch& batch) {
  std::string pattern;
  for (const char c : batch.stem.string()) {
    if (c == '\\') return "/dev/null";  // a backslash would switch all patterns off
    pattern += c == '%' ? "%%" : std::string(1, c);
  }
  return pattern + "/slurm_%a.txt";
}

std::string words_of_slurm(const SlurmBatch& batch, int index) {
  std::ifstream file(batch.stem / fmt::format("slurm_{}.txt", index));
  std::string words;
  for (std::string line; std::getline(file, line);)
    if (!trimmed(line).empty()) words = trimmed(line);
  return words;
}

void close_batch(const SlurmBatch& batch) { fs::remove_all(batch.stem); }

// The script stays, so that its number is not given again.
void discard_batch(const SlurmBatch& batch) {
  fs::remove(batch.file(".tasks"));
  fs::remove_all(batch.stem);
}

}  // namespace knap
