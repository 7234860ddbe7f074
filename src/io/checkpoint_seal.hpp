#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace knap {

/// Size [bytes] of the seal in front of the HDF5 content: the smallest HDF5 user block, so that other programs still
/// find an ordinary HDF5 file.
inline constexpr std::size_t seal_size = 512;

/// Text of seal_size bytes: what this file is, its version, size and checksum. `content` is all that follows.
std::string checkpoint_seal(std::uint32_t version, std::string_view content);

/// Reads the file once and throws InputError unless it is a checkpoint of this version, whole and unchanged. Run before
/// HDF5 sees the file, which is not hardened against damaged input.
void check_checkpoint_seal(const std::filesystem::path& path, std::uint32_t known_version);

}  // namespace knap
