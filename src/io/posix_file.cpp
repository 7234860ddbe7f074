#include "io/posix_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "core/errors.hpp"

namespace knap {

PosixFile::PosixFile(PosixFile&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

PosixFile& PosixFile::operator=(PosixFile&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

PosixFile::~PosixFile() { close(); }

void PosixFile::close() {
  if (is_open()) ::close(descriptor_);
  descriptor_ = -1;
}

PosixFile open_file(const std::filesystem::path& path, int flags) {
  constexpr mode_t permissions = 0666;  // less the user's umask
  PosixFile file(::open(path.c_str(), flags | O_CLOEXEC, permissions));
  if (!file.is_open()) throw_file_error(path, "open");
  return file;
}

void write_all(const PosixFile& file, std::string_view bytes, const std::filesystem::path& path) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file.descriptor(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw_file_error(path, "write");
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void throw_file_error(const std::filesystem::path& path, std::string_view what) {
  const std::string reason = std::generic_category().message(errno);
  throw RuntimeFailure(fmt::format("{}: cannot {}: {}", path.string(), what, reason));
}

}  // namespace knap
