#pragma once
#include <filesystem>
#include <string_view>

namespace knap {

/// Owns a POSIX file descriptor.
class PosixFile {
 public:
  PosixFile() = default;
  explicit PosixFile(int descriptor) : descriptor_(descriptor) {}
  PosixFile(PosixFile&& other) noexcept;
  PosixFile& operator=(PosixFile&& other) noexcept;
  ~PosixFile();

  int descriptor() const { return descriptor_; }
  bool is_open() const { return descriptor_ >= 0; }
  void close();

 private:
  int descriptor_ = -1;
};

/// open(2) with `flags`, closed on exec. Throws RuntimeFailure naming path and reason.
PosixFile open_file(const std::filesystem::path& path, int flags);
/// Writes all of `bytes`, whatever it takes. Throws RuntimeFailure naming path and reason.
void write_all(const PosixFile& file, std::string_view bytes, const std::filesystem::path& path);
/// Ends with RuntimeFailure("<path>: cannot <what>: <reason from errno>").
[[noreturn]] void throw_file_error(const std::filesystem::path& path, std::string_view what);

}  // namespace knap
