#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace knap {

/// The version of the arrays' meaning that this program writes, and the only one it reads.
inline constexpr std::uint32_t checkpoint_version = 1;

/// The named arrays a run continues from. A '/' in a name makes a folder of it; "a" and "a/b" exclude each other.
struct Checkpoint {
  std::uint32_t version = checkpoint_version;
  std::map<std::string, std::vector<double>> doubles;
  std::map<std::string, std::vector<std::int32_t>> ints;
  std::map<std::string, std::vector<std::uint8_t>> bytes;
  std::map<std::string, std::string> texts;
};

/// Writes an HDF5 file in one step: killed at any moment, the old file or the new one is there, whole. Throws
/// RuntimeFailure naming path and reason.
void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint);

/// Reads back the same bits. Throws InputError for a missing or foreign file, an unknown version, a truncated or
/// corrupted file.
Checkpoint read_checkpoint(const std::filesystem::path& path);

}  // namespace knap
