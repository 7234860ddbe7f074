#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "config/run_config.hpp"
#include "io/folder_lock.hpp"

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
  std::filesystem::path force_displacement() const { return path / "force_displacement.csv"; }
  std::filesystem::path force_plot() const { return path / "force_displacement.png"; }
  std::filesystem::path checkpoint() const { return path / "checkpoint.h5"; }
  // Of repeated impacts, each with a folder of its own in this one.
  std::filesystem::path impacts() const { return path / "impacts.csv"; }
  std::filesystem::path impacts_plot() const { return path / "impacts.png"; }
  RunFolder impact(int number) const { return {path / ("impact_" + std::to_string(number))}; }
};

/// The folder of a run, locked; the run has not started yet. Until it starts nothing that lies there is touched, so
/// that a case that is refused, or interrupted before its first step, leaves everything as it was.
class PendingRunFolder {
 public:
  /// Makes the folder if there is none. Throws InputError when that cannot be done, when it holds something that must
  /// not be touched, or is not one of this case.
  PendingRunFolder(const std::filesystem::path& path, FolderUse use, const RunConfig& config);
  /// Removes the folder again if it was made here and has stayed empty.
  ~PendingRunFolder();
  PendingRunFolder(const PendingRunFolder&) = delete;
  PendingRunFolder& operator=(const PendingRunFolder&) = delete;

  /// The run starts: what an old one wrote goes, and effective.toml comes; to resume, all stays as it is. Throws as the
  /// constructor, for the folder may have changed since.
  RunFolder start() const;

 private:
  RunFolder folder_;
  FolderUse use_;
  const RunConfig& config_;
  bool is_made_here_ = false;
  std::optional<FolderLock> lock_;
};

}  // namespace knap
