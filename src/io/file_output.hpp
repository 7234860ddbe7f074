#pragma once
#include <filesystem>
#include <initializer_list>
#include <string_view>

namespace knap {

/// A file that appears whole or not at all: written under a temporary name in the same folder, then renamed over
/// `path`. Without commit() the destructor removes the temporary and leaves what was at `path`.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Where to write until commit().
  const std::filesystem::path& temporary() const { return temporary_; }
  /// Flushes file and folder to the disk around the rename. Throws RuntimeFailure.
  void commit();

 private:
  std::filesystem::path path_;
  std::filesystem::path temporary_;
  bool committed_ = false;
};

/// Replaces the file at `path` by `text` (any bytes) in one step. Throws RuntimeFailure naming path and reason; then
/// the old file is untouched.
void write_text_atomically(const std::filesystem::path& path, std::string_view text);
/// The same for a file of several parts, one after the other.
void write_parts_atomically(const std::filesystem::path& path, std::initializer_list<std::string_view> parts);

}  // namespace knap
