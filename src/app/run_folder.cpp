#include "app/run_folder.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "config/load_config.hpp"
#include "config/schema.hpp"
#include "core/errors.hpp"
#include "io/file_output.hpp"

namespace knap {
namespace {

namespace fs = std::filesystem;

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

bool holds_a_run(const RunFolder& folder, const RunConfig& config) {
  std::ifstream file(folder.effective());
  std::string line;
  return std::getline(file, line) && line == first_line(effective_toml(config));
}

void remove_frames(const fs::path& folder, std::string_view stem) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) return;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(stem) && name.ends_with(".vtu")) fs::remove(entry.path());
  }
  if (fs::is_empty(folder)) fs::remove(folder);
}

// All but effective.toml, by which a folder is known as a run's: the new one replaces it.
void remove_results(const RunFolder& folder) {
  for (const char* name : {"log.txt", "report.json", "history.csv", "fragments.csv", "size_distribution.csv",
                           "picture.png", "checkpoint.h5", "frames.pvd", "cracks.pvd", "tools.pvd",
                           "force_displacement.csv", "force_displacement.png", "impacts.csv", "impacts.png"})
    fs::remove(folder.path / name);
  remove_frames(folder.path / "frames", "frame_");
  remove_frames(folder.path / "cracks", "cracks_");
  remove_frames(folder.path / "tools", "tools_");
  for (int number = 1; fs::is_directory(folder.impact(number).path); ++number) {
    remove_results(folder.impact(number));
    if (fs::is_empty(folder.impact(number).path)) fs::remove(folder.impact(number).path);
  }
}

void make_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw InputError(fmt::format("{}: cannot make this folder: {}", path.string(), error.message()));
}

std::string shown(const Value& value) {
  struct Show {
    std::string operator()(std::monostate) const { return "not set"; }
    std::string operator()(double x) const { return fmt::format("{}", x); }
    std::string operator()(std::int64_t x) const { return std::to_string(x); }
    std::string operator()(bool x) const { return x ? "true" : "false"; }
    std::string operator()(const std::string& x) const { return x; }
    std::string operator()(const Vec3& x) const { return fmt::format("[{}, {}, {}]", x[0], x[1], x[2]); }
  };
  return std::visit(Show{}, value);
}

// What a case has one or many of must be as many as it was.
void require_same_counts(const RunFolder& folder, const RunConfig& before, const RunConfig& config) {
  for (const Section& section : sections())
    if (count(section.scope, before) != count(section.scope, config))
      throw InputError(fmt::format("{}: cannot resume another case: [[{}]] was there {} times and is now {}",
                                   folder.path.string(), section.name, count(section.scope, before),
                                   count(section.scope, config)));
}

// Every key must be as it was; only the number of threads and of wall-clock seconds change nothing in the results.
void require_same_case(const RunFolder& folder, const RunConfig& config) {
  const RunConfig before = load_config(folder.effective());
  require_same_counts(folder, before, config);
  for (const Key& key : schema()) {
    if ((key.section == "run" && key.name == "threads") || key.name == "checkpoint_interval") continue;
    for (std::size_t element = 0; element < count(scope(key), config); ++element) {
      const Value was = key.get(before, element);
      const Value is = key.get(config, element);
      if (was != is)
        throw InputError(fmt::format("{}: cannot resume another case: {}.{} was {} there and is {} now",
                                     folder.path.string(), key.section, key.name, shown(was), shown(is)));
    }
  }
}

void check_resumable(const RunFolder& folder, const RunConfig& config) {
  if (!fs::exists(folder.path))
    throw InputError(fmt::format("{}: there is no such run to resume", folder.path.string()));
  if (!holds_a_run(folder, config))
    throw InputError(fmt::format("{}: holds no run of Knap to resume (no effective.toml)", folder.path.string()));
  require_same_case(folder, config);
  if (!fs::exists((config.impact.repeat > 1 ? folder.impact(1) : folder).checkpoint()))
    throw InputError(
        fmt::format("{}: has no checkpoint.h5 to resume from; start again with --overwrite", folder.path.string()));
}

void check_replaceable(const RunFolder& folder, FolderUse use, const RunConfig& config) {
  const fs::path& path = folder.path;
  std::error_code error;
  if (!fs::exists(path, error)) return;
  if (!fs::is_directory(path, error))
    throw InputError(fmt::format("{}: is a file, not a folder for results", path.string()));
  if (fs::is_empty(path, error)) return;
  if (use == FolderUse::New)
    throw InputError(fmt::format(
        "{}: exists already; give another folder with --out, replace it with --overwrite, or continue it with "
        "--resume",
        path.string()));
  if (!holds_a_run(folder, config))
    throw InputError(
        fmt::format("{}: is not empty and was not written by Knap (no effective.toml); --overwrite leaves it alone",
                    path.string()));
}

void check_folder(const RunFolder& folder, FolderUse use, const RunConfig& config) {
  if (use == FolderUse::Resume)
    check_resumable(folder, config);
  else
    check_replaceable(folder, use, config);
}

}  // namespace

PendingRunFolder::PendingRunFolder(const fs::path& path, FolderUse use, const RunConfig& config)
    : folder_{path}, use_(use), config_(config) {
  check_folder(folder_, use, config);
  std::error_code error;
  is_made_here_ = !fs::exists(path, error);
  make_folder(path);
  if (::access(path.c_str(), W_OK) != 0)
    throw InputError(fmt::format("{}: cannot write into this folder: {}", path.string(), std::strerror(errno)));
  lock_.emplace(path, "run");
}

PendingRunFolder::~PendingRunFolder() {
  std::error_code error;
  if (is_made_here_) fs::remove(folder_.path, error);  // only an empty one
}

RunFolder PendingRunFolder::start() const {
  check_folder(folder_, use_, config_);
  if (use_ == FolderUse::Resume) return folder_;
  remove_results(folder_);
  make_folder(folder_.path);
  write_text_atomically(folder_.effective(), effective_toml(config_));
  return folder_;
}

}  // namespace knap
