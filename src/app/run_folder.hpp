#pragma once
#include <filesystem>
#include <string>

#include "config/run_config.hpp"

namespace knap {

/// What to do with a folder that is there already.
enum class FolderUse { New, Overwrite, Resume };

/// The names of a run's files.
struct RunFolder {
  std::filesystem::path path;
  std::filesystem::path effective() const { return path / "effective.toml"; }
  std::filesystem::path log() const { return path / "log.txt"; }
  std::filesystem::path report() const { return path / "report.json"; }
  std::filesystem::path history() const { return path / "history.csv"; }
  std::filesystem::path fragments() const { return path / "fragments.csv"; }
  std::filesystem::path size_distribution() const { return path / "size_distribution.csv"; }
  std::filesystem::path picture() const { return path / "picture.png"; }
  std::filesystem::path checkpoint() const { return path / "checkpoint.h5"; }
};

/// Makes the folder ready: empty but for effective.toml, or, to resume, as it is. Throws InputError when the folder
/// holds something that must not be touched, or is not one of this case.
RunFolder open_run_folder(const std::filesystem::path& path, FolderUse use, const RunConfig& config);

/// Removes what a run wrote, and the folder if it is empty then.
void remove_run(const RunFolder& folder);

}  // namespace knap
