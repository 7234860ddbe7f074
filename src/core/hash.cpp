#include "core/hash.hpp"

#include <fmt/format.h>

#include <cstring>

namespace knap {

void StateHash::add(std::uint64_t word) {
  state_ = (state_ ^ word) * 0x100000001b3ULL;
  state_ ^= state_ >> 32;
}

void StateHash::add_bytes(const void* data, std::size_t size) {
  const auto* bytes = static_cast<const unsigned char*>(data);
  std::uint64_t word = 0;
  for (; size >= sizeof word; size -= sizeof word, bytes += sizeof word) {
    std::memcpy(&word, bytes, sizeof word);
    add(word);
  }
  if (size > 0) {
    word = 0;
    std::memcpy(&word, bytes, size);
    add(word);
  }
}

std::string StateHash::hex() const { return fmt::format("{:016x}", state_); }

}  // namespace knap
