#pragma once
// The files of the source tree, for tests that read them.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

namespace knap {

/// Paths, relative to the source root and sorted, of the files under some folders that `wanted` accepts.
template <class Wanted>
std::vector<std::string> source_files(const std::vector<std::string>& folders, Wanted&& wanted) {
  const std::filesystem::path root = KNAP_SOURCE_DIR;
  std::vector<std::string> files;
  for (const std::string& folder : folders) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
      if (entry.is_regular_file() && wanted(entry.path()))
        files.push_back(std::filesystem::relative(entry.path(), root).string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

inline std::vector<std::string> lines_of(const std::string& path) {
  std::ifstream file(std::filesystem::path(KNAP_SOURCE_DIR) / path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

inline bool is_cpp(const std::filesystem::path& path) {
  static const std::set<std::string> endings{".hpp", ".cpp", ".h", ".cc", ".cxx", ".ipp", ".inl"};
  return endings.contains(path.extension().string());
}

}  // namespace knap
