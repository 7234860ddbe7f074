#include "io/checkpoint_seal.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <fstream>

#include "core/errors.hpp"
#include "core/hash.hpp"

namespace knap {
namespace {

constexpr std::string_view magic = "Knap checkpoint\n";

/// Everything the reader must be able to trust, in order: the text of the seal is a function of these.
struct SealNumbers {
  std::uint32_t version = 0;
  std::uint64_t size = 0;  ///< of the content [bytes]
  std::string checksum;    ///< of version, size and content
};

std::string seal_text(const SealNumbers& numbers) {
  std::string text =
      fmt::format("{}version {}\nbytes {}\nchecksum {}\n", magic, numbers.version, numbers.size, numbers.checksum);
  text.resize(seal_size - 1, ' ');
  return text + '\n';
}

StateHash begin_checksum(std::uint32_t version, std::uint64_t size) {
  StateHash hash;
  hash.add(version);
  hash.add(size);
  return hash;
}

SealNumbers parsed_seal(const std::string& seal, const std::string& file) {
  if (!seal.starts_with(magic)) throw InputError(fmt::format("{}: not a Knap checkpoint", file));
  SealNumbers numbers;
  unsigned long long size = 0;
  char checksum[17] = {};
  const int found = std::sscanf(seal.c_str() + magic.size(), "version %u bytes %llu checksum %16s", &numbers.version,
                                &size, checksum);
  numbers.size = size;
  numbers.checksum = checksum;
  const bool whole = seal.size() == seal_size;
  if (whole && (found != 3 || seal != seal_text(numbers))) {
    throw InputError(fmt::format("{}: corrupted checkpoint (its first {} bytes have changed)", file, seal_size));
  }
  if (!whole) throw InputError(fmt::format("{}: truncated checkpoint ({} bytes)", file, seal.size()));
  return numbers;
}

std::string checksum_of_rest(std::ifstream& stream, const SealNumbers& numbers) {
  constexpr std::size_t chunk = 1 << 20;  // whole words, so that chunks hash like one array
  std::string buffer(chunk, '\0');
  StateHash hash = begin_checksum(numbers.version, numbers.size);
  while (stream) {
    stream.read(buffer.data(), static_cast<std::streamsize>(chunk));
    hash.add_bytes(buffer.data(), static_cast<std::size_t>(stream.gcount()));
  }
  return hash.hex();
}

}  // namespace

std::string checkpoint_seal(std::uint32_t version, std::string_view content) {
  StateHash hash = begin_checksum(version, content.size());
  hash.add_bytes(content.data(), content.size());
  return seal_text({version, content.size(), hash.hex()});
}

void check_checkpoint_seal(const std::filesystem::path& path, std::uint32_t known_version) {
  const std::string file = path.string();
  std::error_code error;
  const bool is_file = std::filesystem::is_regular_file(path, error);
  std::ifstream stream(path, std::ios::binary);
  if (!is_file || !stream) throw InputError(fmt::format("{}: no such checkpoint, or not readable", file));
  std::string seal(seal_size, '\0');
  stream.read(seal.data(), static_cast<std::streamsize>(seal.size()));
  seal.resize(static_cast<std::size_t>(stream.gcount()));
  const SealNumbers numbers = parsed_seal(seal, file);
  if (numbers.version != known_version) {
    throw InputError(fmt::format("{}: checkpoint of version {}, this program knows version {} only", file,
                                 numbers.version, known_version));
  }
  const std::uint64_t size = std::filesystem::file_size(path) - seal_size;
  if (size != numbers.size) {
    throw InputError(fmt::format("{}: {} checkpoint ({} bytes of content, {} written)", file,
                                 size < numbers.size ? "truncated" : "corrupted", size, numbers.size));
  }
  if (checksum_of_rest(stream, numbers) != numbers.checksum) {
    throw InputError(fmt::format("{}: corrupted checkpoint (its checksum does not match its content)", file));
  }
}

}  // namespace knap
