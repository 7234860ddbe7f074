#pragma once
#include <filesystem>
#include <string_view>

namespace knap {

/// Keeps others of its kind out of a folder as long as it lives, or the process does.
class FolderLock {
 public:
  /// `writer` says what writes there: "run". Throws InputError when another one has the folder.
  FolderLock(const std::filesystem::path& path, std::string_view writer);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_;
};

}  // namespace knap
