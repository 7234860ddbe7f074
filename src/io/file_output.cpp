#include "io/file_output.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "io/posix_file.hpp"

namespace knap {
namespace {

void flush_to_disk(const std::filesystem::path& path, int flags) {
  const PosixFile file = open_file(path, flags);
  // Some file systems cannot flush a folder and say EINVAL.
  if (::fsync(file.descriptor()) != 0 && errno != EINVAL) throw_file_error(path, "flush to disk");
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path path) : path_(std::move(path)), temporary_(path_) { temporary_ += ".tmp"; }

AtomicFile::~AtomicFile() {
  std::error_code ignored;
  if (!committed_) std::filesystem::remove(temporary_, ignored);
}

void AtomicFile::commit() {
  flush_to_disk(temporary_, O_RDONLY);
  if (::rename(temporary_.c_str(), path_.c_str()) != 0) throw_file_error(path_, "write");
  committed_ = true;
  const std::filesystem::path folder = path_.parent_path();
  flush_to_disk(folder.empty() ? "." : folder, O_RDONLY | O_DIRECTORY);
}

void write_text_atomically(const std::filesystem::path& path, std::string_view text) {
  write_parts_atomically(path, {text});
}

void write_parts_atomically(const std::filesystem::path& path, std::initializer_list<std::string_view> parts) {
  AtomicFile atomic(path);
  {
    const PosixFile file = open_file(atomic.temporary(), O_WRONLY | O_CREAT | O_TRUNC);
    for (const std::string_view part : parts) write_all(file, part, path);
  }
  atomic.commit();
}

}  // namespace knap
